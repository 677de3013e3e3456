// Coverage of eight voxels at once: the formula of voxel_coverage.h in single precision, twice as fast as
// double, with a flag for the voxels (one in a hundred) whose error could change the rounded level: these
// need double precision.
//
// The margin, with u = 2^-24 and no position more than D = R + 4 from the path: the components of the
// distance are off by at most u (2 D + 3), because positions are whole numbers and the whole part of `from`
// is subtracted first without rounding. The distance is off by u (6 D + 6), its difference from the radius by
// u (7 D + 7). Smoothing, whose slope is nowhere above 1, adds 6 u. An error in the nearest point's position
// on the path counts only by its square.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "simulation/carving/simd.h"
#include "simulation/carving/voxel_coverage.h"

namespace osteomill {

/// A sweep, for lanes.
struct SimdSweep {
    [[gnu::always_inline]] explicit SimdSweep(const SweepSeenFrom& sweep)
        : from_whole(simd::floats3(glm::floor(sweep.from))),
          from_rest(simd::floats3(sweep.from - glm::floor(sweep.from))),
          along(simd::floats3(sweep.along)),
          // So short a step is none, and its inverse is no number of single precision.
          inverse_length_squared(simd::floats(
              sweep.inverse_length_squared > 1e20 ? 0.0f : static_cast<float>(sweep.inverse_length_squared))),
          radius(simd::floats(static_cast<float>(sweep.radius))),
          margin(static_cast<float>(0x1p-24 * 8.0 * (sweep.radius + 6.0))) {}

    simd::Floats3 from_whole;
    simd::Floats3 from_rest;
    simd::Floats3 along;
    simd::Floats inverse_length_squared;
    simd::Floats radius;
    float margin;  // voxels
};

/// The fractions left, 0 to 255, where single precision is enough.
struct EightLevelsLeft {
    simd::Ints left;
    simd::Ints is_unsure;  ///< -1 where double precision must be asked, else 0
};

/// How far voxels at whole numbers, counted from the sweep's base, are from its path.
[[gnu::always_inline]] inline simd::Floats distance_from(const SimdSweep& sweep,
                                                         const simd::Floats3& voxels) {
    using simd::Floats;
    const Floats wx = voxels.x - sweep.from_whole.x - sweep.from_rest.x;
    const Floats wy = voxels.y - sweep.from_whole.y - sweep.from_rest.y;
    const Floats wz = voxels.z - sweep.from_whole.z - sweep.from_rest.z;
    Floats t =
        (wx * sweep.along.x + (wy * sweep.along.y + wz * sweep.along.z)) * sweep.inverse_length_squared;
    t = simd::larger(t, Floats{});
    t = simd::smaller(t, simd::floats(1.0f));
    const Floats dx = wx - t * sweep.along.x;
    const Floats dy = wy - t * sweep.along.y;
    const Floats dz = wz - t * sweep.along.z;
    return simd::square_root(dx * dx + dy * dy + dz * dz);
}

/// The fractions left in such voxels, 0 to 255.
template <VoxelCoverage coverage>
[[gnu::always_inline]] inline EightLevelsLeft level_left(const SimdSweep& sweep,
                                                         const simd::Floats3& voxels) {
    using simd::Floats;
    using simd::Ints;
    const Floats beyond = distance_from(sweep, voxels) - sweep.radius;
    if constexpr (coverage == VoxelCoverage::binary)
        return {(beyond > 0.0f) & 255, simd::magnitude(beyond) < sweep.margin};

    Floats raised;  // the level before it is rounded down
    if constexpr (coverage == VoxelCoverage::smoothed) {
        constexpr auto rim = static_cast<float>(detail::smoothed_ramp_half);
        constexpr auto bend_from = static_cast<float>(0.5 - 0.5 * detail::smoothed_mean_over);
        constexpr auto bend = static_cast<float>(0.5 / detail::smoothed_mean_over);
        const Floats off = simd::smaller(simd::magnitude(beyond), simd::floats(rim));
        const Floats bent = simd::larger(off - bend_from, Floats{});
        raised = 128.0f + 255.0f * simd::with_sign_of(beyond, off - bent * bent * bend);
    } else {
        const Floats left = simd::larger(beyond + 0.5f, Floats{});
        raised = 0.5f + 255.0f * simd::smaller(left, simd::floats(1.0f));
    }
    const Ints left = __builtin_convertvector(raised, Ints);
    const Floats from_middle = simd::magnitude(raised - simd::to_floats(left) - 0.5f);
    return {left, from_middle > 0.5f - 255.0f * sweep.margin};
}

}  // namespace osteomill
