#include "haptic_server/carving/cover.h"

#include <glm/geometric.hpp>

namespace osteomill {

namespace {

template <VoxelEdges edges>
[[gnu::always_inline]] inline void all_fractions_left(const SweepSeenFrom& sweep, const float* x,
                                                      const float* y, const float* z, std::int32_t* left,
                                                      std::size_t count) {
    const SweepSeenFrom local = sweep;
    for (std::size_t first = 0; first < count; first += cover_lanes)
        for (std::size_t lane = first; lane < first + cover_lanes; ++lane)
            left[lane] = fraction_left<edges>(local, x[lane], y[lane], z[lane]);
}

[[gnu::always_inline]] inline void for_edges(const SweepSeenFrom& sweep, const float* x, const float* y,
                                             const float* z, std::int32_t* left, std::size_t count) {
    if (sweep.edges == VoxelEdges::partial)
        all_fractions_left<VoxelEdges::partial>(sweep, x, y, z, left, count);
    else if (sweep.edges == VoxelEdges::soft)
        all_fractions_left<VoxelEdges::soft>(sweep, x, y, z, left, count);
    else
        all_fractions_left<VoxelEdges::whole>(sweep, x, y, z, left, count);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fractions_left_avx2(const SweepSeenFrom& sweep, const float* x, const float* y,
                                                 const float* z, std::int32_t* left, std::size_t count) {
    for_edges(sweep, x, y, z, left, count);
}
#endif

}  // namespace

SweepSeenFrom::SweepSeenFrom(const Sweep& sweep, const glm::dvec3& base, VoxelEdges voxel_edges)
    : from(sweep.from - base),
      along(sweep.to - sweep.from),
      inverse_length_squared(glm::dot(along, along) > 1e-300 ? 1.0 / glm::dot(along, along) : 0.0),
      radius(sweep.radius),
      edges(voxel_edges) {}

void fractions_left(const SweepSeenFrom& sweep, std::span<const float> x, std::span<const float> y,
                    std::span<const float> z, std::span<std::int32_t> left,
                    [[maybe_unused]] InstructionSet instructions) noexcept {
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) {
        fractions_left_avx2(sweep, x.data(), y.data(), z.data(), left.data(), left.size());
        return;
    }
#endif
    for_edges(sweep, x.data(), y.data(), z.data(), left.data(), left.size());
}

}  // namespace osteomill
