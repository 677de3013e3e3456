// How much of a voxel a sweep of the burr leaves: the fraction is at most one minus the part that the sweep
// covers,
//
//     cover = clamp(1/2 + (R - distance) / h, 0, 1)      partial voxels
//     cover = 1 where distance <= R, else 0              whole voxels, as in the published system
//
// with the distance of the voxel's centre from the path of the burr's centre.
#pragma once

#include <cmath>
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

/// For one voxel at (x, y, z), counted from the sweep's base: the 255 steps of fraction that the sweep leaves
/// at most, 0 to 255. Comparisons are written as the selections that vector units have.
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

/// The same for many. The spans are of one length, a multiple of `cover_lanes`. Real-time safe.
void fractions_left(const SweepSeenFrom& sweep, std::span<const float> x, std::span<const float> y,
                    std::span<const float> z, std::span<std::int32_t> left,
                    InstructionSet instructions) noexcept;

inline constexpr std::size_t cover_lanes = 8;

}  // namespace osteomill
