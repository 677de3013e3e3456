#include "haptic_server/milling/cover.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

/// One voxel. Comparisons are written as the selections that vector units have.
template <VoxelEdges edges>
[[gnu::always_inline]] inline std::int32_t fraction_left(const SweepSeenFrom& sweep, float x, float y,
                                                         float z) {
    const double wx = static_cast<double>(x) - sweep.from.x;
    const double wy = static_cast<double>(y) - sweep.from.y;
    const double wz = static_cast<double>(z) - sweep.from.z;
    double t =
        (wx * sweep.along.x + (wy * sweep.along.y + wz * sweep.along.z)) * sweep.inverse_length_squared;
    t = t < 0.0 ? 0.0 : t;
    t = t > 1.0 ? 1.0 : t;
    const double dx = wx - t * sweep.along.x;
    const double dy = wy - t * sweep.along.y;
    const double dz = wz - t * sweep.along.z;
    const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    if constexpr (edges == VoxelEdges::whole) {
        return distance <= sweep.radius ? 0 : 255;
    } else {
        double cover = 0.5 + sweep.radius - distance;
        cover = cover < 0.0 ? 0.0 : cover;
        cover = cover > 1.0 ? 1.0 : cover;
        return static_cast<std::int32_t>(255.0 * (1.0 - cover) + 0.5);
    }
}

template <VoxelEdges edges>
[[gnu::always_inline]] inline void all_fractions_left(const SweepSeenFrom& sweep, const float* x,
                                                      const float* y, const float* z, std::int32_t* left,
                                                      std::size_t count) {
    const SweepSeenFrom local = sweep;
    for (std::size_t first = 0; first < count; first += cover_lanes)
        for (std::size_t lane = first; lane < first + cover_lanes; ++lane)
            left[lane] = fraction_left<edges>(local, x[lane], y[lane], z[lane]);
}

[[gnu::always_inline]] inline void for_either_edges(const SweepSeenFrom& sweep, const float* x,
                                                    const float* y, const float* z, std::int32_t* left,
                                                    std::size_t count) {
    if (sweep.edges == VoxelEdges::partial)
        all_fractions_left<VoxelEdges::partial>(sweep, x, y, z, left, count);
    else
        all_fractions_left<VoxelEdges::whole>(sweep, x, y, z, left, count);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fractions_left_avx2(const SweepSeenFrom& sweep, const float* x, const float* y,
                                                 const float* z, std::int32_t* left, std::size_t count) {
    for_either_edges(sweep, x, y, z, left, count);
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
    for_either_edges(sweep, x.data(), y.data(), z.data(), left.data(), left.size());
}

}  // namespace osteomill
