// What a sweep leaves of eight voxels at once: the formula of cover.h in single precision, which is twice as
// fast as double, and where its error could round to another of the 255 steps: there (one voxel in a hundred)
// double precision must be asked.
//
// The margin: with u = 2^-24 and no place more than D = R + 4 from the path, the components of the distance
// are off by at most u (2 D + 3) (places are whole numbers, and the whole part of `from` is taken off them
// first, which rounds nothing), the distance by u (6 D + 6), less what it is compared with by u (7 D + 7),
// and what soft voxels make of that, which nowhere rises faster, by 6 u more. An error in the nearest point's
// place on the path counts only by its square.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "haptic_server/carving/cover.h"
#include "haptic_server/carving/lanes.h"

namespace osteomill {

/// A sweep, for lanes.
struct SweepForLanes {
    explicit SweepForLanes(const SweepSeenFrom& sweep)
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
struct LeftLanes {
    lanes::Ints left;
    lanes::Ints is_unsure;  ///< -1 where double precision must be asked, else 0
};

namespace detail {
/// A number of the 255 steps, known within `off`, rounded as in cover.h.
[[gnu::always_inline]] inline LeftLanes rounded_code(const lanes::Floats& code, float off) {
    const lanes::Floats raised = code + 0.5f;
    const lanes::Ints left = __builtin_convertvector(raised, lanes::Ints);
    const lanes::Floats rest = raised - lanes::to_floats(left);
    return {left, (rest < off) | (rest > 1.0f - off)};
}
}  // namespace detail

/// How far voxels at whole numbers, counted from the sweep's base, are from its way.
[[gnu::always_inline]] inline lanes::Floats distance_from(const SweepForLanes& sweep, const lanes::Floats& x,
                                                          const lanes::Floats& y, const lanes::Floats& z) {
    using lanes::Floats;
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
    return lanes::square_root(dx * dx + dy * dy + dz * dz);
}

/// What is left of such voxels, 0 to 255, not rounded; within 255 margins. Not for whole voxels.
template <VoxelEdges edges>
[[gnu::always_inline]] inline lanes::Floats code_left(const SweepForLanes& sweep, const lanes::Floats& x,
                                                      const lanes::Floats& y, const lanes::Floats& z) {
    using lanes::Floats;
    static_assert(edges != VoxelEdges::whole);
    const Floats zero{};
    const Floats distance = distance_from(sweep, x, y, z);
    Floats code;
    if constexpr (edges == VoxelEdges::soft) {
        constexpr auto rim = static_cast<float>(detail::soft_ramp_half);
        constexpr auto bend_from = static_cast<float>(0.5 - 0.5 * detail::soft_mean_over);
        constexpr auto bend = static_cast<float>(0.5 / detail::soft_mean_over);
        const Floats beyond = distance - sweep.radius;
        Floats off = beyond < 0.0f ? -beyond : beyond;
        off = off > rim ? zero + rim : off;
        Floats bent = off - bend_from;
        bent = bent < 0.0f ? zero : bent;
        const Floats rise = off - bent * bent * bend;
        code = 127.5f + 255.0f * (beyond < 0.0f ? -rise : rise);
    } else {
        code = 255.0f * (distance - (sweep.radius - 0.5f));
    }
    code = code < 0.0f ? zero : code;
    return code > 255.0f ? zero + 255.0f : code;
}

/// What is left of such voxels, 0 to 255.
template <VoxelEdges edges>
[[gnu::always_inline]] inline LeftLanes fraction_left(const SweepForLanes& sweep, const lanes::Floats& x,
                                                      const lanes::Floats& y, const lanes::Floats& z) {
    using lanes::Floats;
    using lanes::Ints;
    if constexpr (edges == VoxelEdges::whole) {
        const Floats distance = distance_from(sweep, x, y, z);
        const Ints left = (distance > sweep.radius) & 255;
        const Floats beyond = distance - sweep.radius;
        return {left, (beyond < sweep.margin) & (beyond > -sweep.margin)};
    } else {
        return detail::rounded_code(code_left<edges>(sweep, x, y, z), 255.0f * sweep.margin);
    }
}

}  // namespace osteomill
