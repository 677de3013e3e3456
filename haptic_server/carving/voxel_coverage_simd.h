// Coverage of eight voxels at once: the formula of voxel_coverage.h in single precision, which is
// twice as fast as double, and where its error could round to another of the 255 levels: there (one voxel in
// a hundred) double precision must be asked.
//
// The margin: with u = 2^-24 and no position more than D = R + 4 from the path, the components of the
// distance are off by at most u (2 D + 3) (positions are whole numbers, and the whole part of `from` is taken
// off them first, which rounds nothing), the distance by u (6 D + 6), less what it is compared with by u (7 D
// + 7), and what smoothing makes of that, which nowhere rises faster, by 6 u more. An error in the nearest
// point's position on the path counts only by its square.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "haptic_server/carving/simd.h"
#include "haptic_server/carving/voxel_coverage.h"

namespace osteomill {

/// A sweep, for lanes.
struct SimdSweep {
    explicit SimdSweep(const SweepSeenFrom& sweep)
        : from_whole(glm::floor(sweep.from)),
          from_rest(sweep.from - glm::floor(sweep.from)),
          along(sweep.along),
          // So short a step is none, and its inverse is no number of single precision.
          inverse_length_squared(
              sweep.inverse_length_squared > 1e20 ? 0.0f : static_cast<float>(sweep.inverse_length_squared)),
          radius(static_cast<float>(sweep.radius)),
          margin(static_cast<float>(0x1p-24 * 8.0 * (sweep.radius + 6.0))) {}

    glm::vec3 from_whole;
    glm::vec3 from_rest;
    glm::vec3 along;
    float inverse_length_squared;
    float radius;
    float margin;  // voxels
};

/// What is left, 0 to 255, where single precision knows it.
struct EightLevelsLeft {
    simd::Ints left;
    simd::Ints is_unsure;  ///< -1 where double precision must be asked, else 0
};

namespace detail {
/// A number of the 255 levels, known within `off`, rounded as in voxel_coverage.h.
[[gnu::always_inline]] inline EightLevelsLeft rounded_level(const simd::Floats& level, float off) {
    const simd::Floats raised = level + 0.5f;
    const simd::Ints left = __builtin_convertvector(raised, simd::Ints);
    const simd::Floats rest = raised - simd::to_floats(left);
    return {left, (rest < off) | (rest > 1.0f - off)};
}
}  // namespace detail

/// How far voxels at whole numbers, counted from the sweep's base, are from its path.
[[gnu::always_inline]] inline simd::Floats distance_from(const SimdSweep& sweep, const simd::Floats& x,
                                                         const simd::Floats& y, const simd::Floats& z) {
    using simd::Floats;
    const Floats zero{};
    const Floats wx = x - sweep.from_whole.x - sweep.from_rest.x;
    const Floats wy = y - sweep.from_whole.y - sweep.from_rest.y;
    const Floats wz = z - sweep.from_whole.z - sweep.from_rest.z;
    Floats t =
        (wx * sweep.along.x + (wy * sweep.along.y + wz * sweep.along.z)) * sweep.inverse_length_squared;
    t = t < 0.0f ? zero : t;
    t = t > 1.0f ? zero + 1.0f : t;
    const Floats dx = wx - t * sweep.along.x;
    const Floats dy = wy - t * sweep.along.y;
    const Floats dz = wz - t * sweep.along.z;
    return simd::square_root(dx * dx + dy * dy + dz * dz);
}

/// What is left of such voxels, 0 to 255, not rounded; within 255 margins. Not for binary coverage.
template <VoxelCoverage coverage>
[[gnu::always_inline]] inline simd::Floats level_left_unrounded(const SimdSweep& sweep, const simd::Floats& x,
                                                                const simd::Floats& y,
                                                                const simd::Floats& z) {
    using simd::Floats;
    static_assert(coverage != VoxelCoverage::binary);
    const Floats zero{};
    const Floats distance = distance_from(sweep, x, y, z);
    Floats level;
    if constexpr (coverage == VoxelCoverage::smoothed) {
        constexpr auto rim = static_cast<float>(detail::smoothed_ramp_half);
        constexpr auto bend_from = static_cast<float>(0.5 - 0.5 * detail::smoothed_mean_over);
        constexpr auto bend = static_cast<float>(0.5 / detail::smoothed_mean_over);
        const Floats beyond = distance - sweep.radius;
        Floats off = beyond < 0.0f ? -beyond : beyond;
        off = off > rim ? zero + rim : off;
        Floats bent = off - bend_from;
        bent = bent < 0.0f ? zero : bent;
        const Floats rise = off - bent * bent * bend;
        level = 127.5f + 255.0f * (beyond < 0.0f ? -rise : rise);
    } else {
        level = 255.0f * (distance - (sweep.radius - 0.5f));
    }
    level = level < 0.0f ? zero : level;
    return level > 255.0f ? zero + 255.0f : level;
}

/// What is left of such voxels, 0 to 255.
template <VoxelCoverage coverage>
[[gnu::always_inline]] inline EightLevelsLeft level_left(const SimdSweep& sweep, const simd::Floats& x,
                                                         const simd::Floats& y, const simd::Floats& z) {
    using simd::Floats;
    using simd::Ints;
    if constexpr (coverage == VoxelCoverage::binary) {
        const Floats distance = distance_from(sweep, x, y, z);
        const Ints left = (distance > sweep.radius) & 255;
        const Floats beyond = distance - sweep.radius;
        return {left, (beyond < sweep.margin) & (beyond > -sweep.margin)};
    } else {
        return detail::rounded_level(level_left_unrounded<coverage>(sweep, x, y, z), 255.0f * sweep.margin);
    }
}

}  // namespace osteomill
