// Part of a voxel that a sweep of the burr covers: the fraction that it leaves is at most one minus that,
//
//     cover = clamp(1/2 + (R - distance) / h, 0, 1)      linear
//     cover = that, smoothed                             smoothed
//     cover = 1 where distance <= R, else 0              binary, as in the published system
//
// with the distance of the voxel's centre from the path of the burr's centre.
//
// A ramp of one voxel is the coverage of a cube by a plane along its faces. Aslant, a plane takes up to sqrt
// 3 voxels to cover it, and chips thinner than a voxel show the corners of the ramp as a ripple. Smoothed
// coverage has the ramp's mean over b = 1 / sqrt 2 voxel: with u = (R - distance) / h and a = min(|u|, 1/2 +
// b/2),
//
//     cover = 1/2 + sign(u) (a - max(0, a - 1/2 + b/2)^2 / (2 b))
//
// which is smooth, and whose burr reaches b/2 farther.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "simulation/carving/instruction_set.h"
#include "simulation/carving/sweep.h"

namespace osteomill {

/// Whether a voxel can be partly gone.
enum class VoxelCoverage { linear, smoothed, binary };

namespace detail {
inline constexpr double smoothed_mean_over = 0.70710678118654752;
/// How far from the surface a voxel's centre is that is all or nothing.
inline constexpr double smoothed_ramp_half = 0.5 + 0.5 * smoothed_mean_over;
}  // namespace detail

/// The length over which the ramp is averaged, voxels: 0 for linear coverage, and for binary, which has no
/// ramp.
constexpr double smoothing_voxels(VoxelCoverage coverage) {
    return coverage == VoxelCoverage::smoothed ? detail::smoothed_mean_over : 0.0;
}

/// The largest distance of a voxel's centre from the burr's surface, voxels, at which the voxel is cut in
/// part. Beyond it the voxel is whole or gone: the ramp is within half of one of the 255 levels of its end
/// (smoothed: it ends as a parabola, v^2 / (2 b) = 1 / 510 at v = 0.0527).
constexpr double rim_voxels(VoxelCoverage coverage) {
    if (coverage == VoxelCoverage::binary) return 0.0;
    return coverage == VoxelCoverage::linear ? 0.5 - 0.5 / 255.0 : detail::smoothed_ramp_half - 0.0526;
}

/// The 255 levels of fraction that a burr leaves at most of a voxel whose centre lies `beyond` outside its
/// surface (negative: inside), voxels. Comparisons are written as the selections that vector units have.
template <VoxelCoverage coverage>
[[gnu::always_inline]] inline std::int32_t level_left_at(double beyond) {
    if constexpr (coverage == VoxelCoverage::binary) {
        return beyond <= 0.0 ? 0 : 255;
    } else if constexpr (coverage == VoxelCoverage::smoothed) {
        constexpr double mean_over = detail::smoothed_mean_over;
        double off = std::abs(beyond);
        off = off > detail::smoothed_ramp_half ? detail::smoothed_ramp_half : off;
        double bent = off - (0.5 - 0.5 * mean_over);
        bent = bent < 0.0 ? 0.0 : bent;
        const double rise = off - bent * bent * (0.5 / mean_over);
        const double left = 0.5 + std::copysign(rise, beyond);
        return static_cast<std::int32_t>(255.0 * left + 0.5);
    } else {
        double cover = 0.5 - beyond;
        cover = cover < 0.0 ? 0.0 : cover;
        cover = cover > 1.0 ? 1.0 : cover;
        return static_cast<std::int32_t>(255.0 * (1.0 - cover) + 0.5);
    }
}

/// The same, for a coverage that is not known before.
inline std::int32_t level_left_at(VoxelCoverage coverage, double beyond) {
    if (coverage == VoxelCoverage::linear) return level_left_at<VoxelCoverage::linear>(beyond);
    if (coverage == VoxelCoverage::smoothed) return level_left_at<VoxelCoverage::smoothed>(beyond);
    return level_left_at<VoxelCoverage::binary>(beyond);
}

/// A short sweep, seen from a voxel nearby, reduced to the values that the inner loop needs.
struct SweepSeenFrom {
    /// `sweep` in voxel coordinates. `base` is a whole number of voxels, so nothing is rounded.
    SweepSeenFrom(const Sweep& sweep, const glm::dvec3& base, VoxelCoverage voxel_coverage);

    glm::dvec3 from;
    glm::dvec3 along;
    double inverse_length_squared;  ///< 0 for a ball at rest
    double radius;
    VoxelCoverage coverage;
};

/// For one voxel at (x, y, z), counted from the sweep's base: the 255 levels of fraction that the sweep
/// leaves at most, 0 to 255.
template <VoxelCoverage coverage>
[[gnu::always_inline]] inline std::int32_t level_left(const SweepSeenFrom& sweep, float x, float y, float z) {
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
    return level_left_at<coverage>(std::sqrt(dx * dx + dy * dy + dz * dz) - sweep.radius);
}

/// The same for many. The spans are of one length, a multiple of `coverage_batch`. Real-time safe.
void levels_left(const SweepSeenFrom& sweep, std::span<const float> x, std::span<const float> y,
                 std::span<const float> z, std::span<std::int32_t> left,
                 InstructionSet instructions) noexcept;

inline constexpr std::size_t coverage_batch = 8;

}  // namespace osteomill
