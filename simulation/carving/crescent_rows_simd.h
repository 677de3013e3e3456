// Rows of a crescent (crescent_rows.h), eight at a time and without a branch.
#pragma once

#include "simulation/carving/crescent_rows.h"
#include "simulation/carving/simd.h"

namespace osteomill {

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

}  // namespace osteomill
