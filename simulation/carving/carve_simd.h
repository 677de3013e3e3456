// Eight voxels at once, for the inner loops of carving: rows of a crescent (crescent_rows.h) and the
// coverage of a voxel (voxel_coverage.h).
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "simulation/carving/crescent_rows.h"
#include "simulation/carving/simd.h"
#include "simulation/carving/voxel_coverage.h"

namespace osteomill {

// Rows of a crescent (crescent_rows.h), eight at a time and without a branch.

/// The voxels of eight neighbouring rows that may change: in each, first <= x < end left of the ball's inside
/// and right of it. Either part may be empty (end <= first); they do not overlap.
struct EightRows {
    simd::Ints left_first;
    simd::Ints left_end;
    simd::Ints right_first;
    simd::Ints right_end;
};

namespace detail {

/// For positions that are not negative: the conversion itself rounds down.
[[gnu::always_inline]] inline simd::Ints floor_of(const simd::Floats& position) {
    return __builtin_convertvector(position, simd::Ints);
}

/// The same, rounding up but for the slack: never beyond the ceiling.
[[gnu::always_inline]] inline simd::Ints ceiling_of(const simd::Floats& position) {
    return floor_of(position + static_cast<float>(1.0 - 0.1 * CrescentRows::slack_voxels));
}

}  // namespace detail

/// Rows y to y + 7 of slice z.
[[gnu::always_inline]] inline EightRows eight_rows(const CrescentRows::Shape& s, int first_y, int z) {
    using simd::Floats;
    using simd::Ints;
    constexpr auto slack = static_cast<float>(CrescentRows::slack_voxels);
    const Floats zero{};
    const float to_z = static_cast<float>(z) - s.to.z;
    const float from_z = static_cast<float>(z) - s.from.z;
    const Floats y = simd::to_floats(first_y + simd::counting());
    const Floats to_y = y - s.to.y;
    const Floats from_y = y - s.from.y;
    const Floats outer_squared = (s.outer_squared - to_z * to_z) - to_y * to_y;
    const Floats inner_squared = (s.inner_squared - from_z * from_z) - from_y * from_y;
    const Floats outer = simd::square_root(outer_squared < 0.0f ? zero : outer_squared);
    const Floats inner = simd::square_root(inner_squared < 0.0f ? zero : inner_squared);
    const Floats ahead = from_z * s.direction.z + from_y * s.direction.y;
    const Floats plane = s.plane_at + ahead * s.plane_per_ahead;
    const Floats row_ahead = s.row_weight * (ahead + std::abs(s.direction.x) * (outer + 2.0f) + slack);
    const Floats right_of = s.right_weight * plane;
    const Floats left_of = s.left_weight * plane + (1.0f - s.left_weight) * s.last_x;

    Floats first = s.to.x - outer;
    first = first < right_of ? right_of : first;
    first = first < s.first_x ? zero + s.first_x : first;
    Floats last = s.to.x + outer;
    last = last > left_of ? left_of : last;
    last = last > s.last_x ? zero + s.last_x : last;
    const Ints is_empty =
        (last < first) | (outer_squared < 0.0f) | (row_ahead < 0.0f) | (y < s.first_y) | (y > s.last_y);
    last = is_empty ? zero - 1.0f : last;

    const Ints whole_first = detail::ceiling_of(first);
    const Ints whole_end = detail::floor_of(last) + 1;
    // If the row misses the inner ball, the left part is all of it.
    const Ints misses = inner_squared < 0.0f;
    const Ints left_end =
        simd::smaller(misses ? whole_end : detail::floor_of(s.from.x - inner) + 1, whole_end);
    const Ints right_first = misses ? whole_end : detail::ceiling_of(s.from.x + inner);
    return {whole_first, left_end, simd::larger(right_first, simd::larger(whole_first, left_end)), whole_end};
}

// Coverage of eight voxels at once: the formula of voxel_coverage.h in single precision, twice as fast as
// double, with a flag for the voxels (one in a hundred) whose error could change the rounded level: these
// need double precision.
//
// The margin, with u = 2^-24 and no position more than D = R + 4 from the path: the components of the
// distance are off by at most u (2 D + 3), because positions are whole numbers and the whole part of `from`
// is subtracted first without rounding. The distance is off by u (6 D + 6), its difference from the radius by
// u (7 D + 7). Smoothing, whose slope is nowhere above 1, adds 6 u. An error in the nearest point's position
// on the path counts only by its square.

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
