// How much of a voxel a sweep of the burr leaves: the fraction is at most one minus the part that the sweep
// covers,
//
//     cover = clamp(1/2 + (R - distance) / h, 0, 1)      partial voxels
//     cover = 1 where distance <= R, else 0              whole voxels, as in the published system
//
// with the distance of the voxel's centre from the path of the burr's centre.
#pragma once

#include <cstdint>
#include <span>

#include "haptic_server/milling/instruction_set.h"
#include "haptic_server/milling/sweep.h"

namespace osteomill {

/// Whether a voxel can be partly gone.
enum class VoxelEdges { partial, whole };

/// A short sweep, seen from a voxel nearby; what the inner loop needs of it.
struct SweepSeenFrom {
    /// `sweep` in voxel coordinates. `base` is a whole number of voxels, so nothing is rounded.
    SweepSeenFrom(const Sweep& sweep, const glm::dvec3& base, VoxelEdges voxel_edges);

    glm::dvec3 from;
    glm::dvec3 along;
    double inverse_length_squared;  ///< 0 for a ball at rest
    double radius;
    VoxelEdges edges;
};

/// For voxels at (x, y, z), counted from the sweep's base: the 255 steps of fraction that it leaves at most,
/// 0 to 255. The spans are of one length, a multiple of `cover_lanes`. Real-time safe.
void fractions_left(const SweepSeenFrom& sweep, std::span<const float> x, std::span<const float> y,
                    std::span<const float> z, std::span<std::int32_t> left,
                    InstructionSet instructions) noexcept;

inline constexpr std::size_t cover_lanes = 8;

}  // namespace osteomill
