// A guess of what milling has left of a brick, from the way that the burr went: exact arithmetic, so that who
// packs an edit and who unpacks it guess the same on any machine.
//
// A voxel whose centre has the distance d from the way of the burr's centre keeps, of 255 steps,
//
//     255 * (1/2 + sign(d - R) * rise), rounded to the nearest
//     rise = a - max(0, a - 1/2 + b/2)^2 / (2 b)
//     a    = min(|d - R|, 1/2 + b/2)
//
// with all lengths in voxels: a ramp of one voxel, smoothed to its mean over b voxels. It is the law by which
// milling removes bone: partial voxels for b = 0, where rise is a, soft voxels for b = 1 / sqrt 2. Here
// lengths are whole multiples of 1/65536 voxel; the nearest point of the way, d, 1/2 + b/2, 1/2 - b/2 and the
// quotient are each rounded down to one (the point towards zero, counted from the way's beginning). It is a
// guess: the way is taken for straight, and what was there before is not known.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <variant>

#include "common/bone/brick.h"
#include "common/wire/voxel_mask.h"
#include "common/wire/wire_error.h"
#include "osteomill/v1/bone.pb.h"

namespace osteomill {

/// A straight way of a sphere, in multiples of 1/65536 voxel; positions from the centre of voxel (0, 0, 0).
struct GuessedSweep {
    static constexpr std::int64_t units_per_voxel = 65536;
    static constexpr std::int64_t longest_way_voxels = 64;  ///< along each axis
    static constexpr std::int64_t largest_radius_voxels = 256;

    std::array<std::int64_t, 3> from{};
    std::array<std::int64_t, 3> to{};
    std::int64_t radius = 0;
    std::int64_t smoothing = 0;  ///< b, 0 to a voxel

    bool operator==(const GuessedSweep&) const = default;
};

/// All in voxels. Nothing where it is not finite, too long or thick for the arithmetic to be exact, or
/// smoothed over more than one.
std::optional<GuessedSweep> guessed_sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
                                          double smoothing = 0.0);

v1::GuessedSweep to_message(const GuessedSweep& sweep);
std::variant<GuessedSweep, WireError> guessed_sweep_from(const v1::GuessedSweep& message);

struct BrickGuess {
    VoxelMask changed;  ///< less is left than at the way's beginning alone
    ByteBrick left{};   ///< of these; of the others 0
};

/// `brick`: its place, counted in bricks.
BrickGuess guess_brick(const GuessedSweep& sweep, const glm::ivec3& brick);

}  // namespace osteomill
