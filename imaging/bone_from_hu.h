// The bone that is built from CT numbers on its own grid, which come slice by slice.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "common/bone/bone.h"
#include "common/bone/grid.h"
#include "common/scene/stiffness_relation.h"

namespace osteomill {

/// CT numbers slice after slice, z ascending, from which a bone is built if the whole would not fit in
/// memory.
struct HuSlices {
    Grid grid;
    bool labelled = false;
    /// Fills `hu` with the next slices, as many as fit (x fastest, then y, then z; never more than are left),
    /// and `tissue`, as long, with their labels if there are labels; else it is empty.
    std::function<void(std::span<std::int16_t> hu, std::span<std::uint8_t> tissue)> read;
    /// The distance of a voxel's centre from the surface, voxels, negative in bone, right within a voxel of
    /// the surface. For a surface that is known better than CT numbers tell it, such as a phantom's; else
    /// empty.
    std::function<double(const glm::ivec3& voxel)> surface_distance_voxels{};
};

/// The HU of an empty voxel.
inline constexpr std::int16_t air_hu = -1000;

/// Bone is where HU reaches the threshold. A voxel that the surface HU = threshold passes through is filled
/// in part: fraction = clamp(1/2 + (HU - threshold) / (|grad HU| h), 0, 1), the same cover as the burr's, so
/// that the surface is smooth and its volume right to a fraction of a voxel; if the slices know the distance
/// from their surface, fraction = clamp(1/2 - distance, 0, 1). Stiffness comes from the relation; a voxel on
/// the surface, whose HU is a mixture with its surroundings, has the stiffness that the highest HU of its six
/// neighbours give, and, if it has no label itself, the label of the bone beside it on the side where the HU
/// rise most. No other voxel takes a label from a neighbour: unlabelled bone stays unlabelled. The bone is
/// stored homogeneous (no stiffness channel) if every code is the same, and unlabelled if the slices are.
/// Holds 18 slices at a time beside the bone. Throws std::invalid_argument for a bad grid, threshold or
/// relation, and any exception of reading the slices.
Bone bone_from_hu(const HuSlices& slices, double threshold_hu, const StiffnessRelation& relation);

}  // namespace osteomill
