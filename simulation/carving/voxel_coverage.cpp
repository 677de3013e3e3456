#include "simulation/carving/voxel_coverage.h"

#include <glm/geometric.hpp>

namespace osteomill {

namespace {

template <VoxelCoverage coverage>
[[gnu::always_inline]] inline void all_fractions_left(const SweepSeenFrom& sweep, const float* x,
                                                      const float* y, const float* z, std::int32_t* left,
                                                      std::size_t count) {
    const SweepSeenFrom local = sweep;
    for (std::size_t first = 0; first < count; first += coverage_batch)
        for (std::size_t lane = first; lane < first + coverage_batch; ++lane)
            left[lane] = level_left<coverage>(local, x[lane], y[lane], z[lane]);
}

[[gnu::always_inline]] inline void for_coverage(const SweepSeenFrom& sweep, const float* x, const float* y,
                                                const float* z, std::int32_t* left, std::size_t count) {
    if (sweep.coverage == VoxelCoverage::linear)
        all_fractions_left<VoxelCoverage::linear>(sweep, x, y, z, left, count);
    else if (sweep.coverage == VoxelCoverage::smoothed)
        all_fractions_left<VoxelCoverage::smoothed>(sweep, x, y, z, left, count);
    else
        all_fractions_left<VoxelCoverage::binary>(sweep, x, y, z, left, count);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void fractions_left_avx2(const SweepSeenFrom& sweep, const float* x, const float* y,
                                                 const float* z, std::int32_t* left, std::size_t count) {
    for_coverage(sweep, x, y, z, left, count);
}
#endif

}  // namespace

SweepSeenFrom::SweepSeenFrom(const Sweep& sweep, const glm::dvec3& base, VoxelCoverage voxel_coverage)
    : from(sweep.from - base),
      along(sweep.to - sweep.from),
      inverse_length_squared(glm::dot(along, along) > 1e-300 ? 1.0 / glm::dot(along, along) : 0.0),
      radius(sweep.radius),
      coverage(voxel_coverage) {}

void levels_left(const SweepSeenFrom& sweep, std::span<const float> x, std::span<const float> y,
                 std::span<const float> z, std::span<std::int32_t> left,
                 [[maybe_unused]] InstructionSet instructions) noexcept {
#if defined(__x86_64__)
    if (instructions == InstructionSet::avx2) {
        fractions_left_avx2(sweep, x.data(), y.data(), z.data(), left.data(), left.size());
        return;
    }
#endif
    for_coverage(sweep, x.data(), y.data(), z.data(), left.data(), left.size());
}

}  // namespace osteomill
