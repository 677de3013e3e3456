// A box of voxels, and dense copies of one channel of the bone within it.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"

namespace osteomill {

struct VoxelBox {
    glm::ivec3 first{0};
    glm::ivec3 size{0};

    bool operator==(const VoxelBox&) const = default;
    std::size_t count() const { return static_cast<std::size_t>(size.x) * size.y * size.z; }
};

/// The bricks' box in voxels of their grid; empty for no bricks.
VoxelBox box_of_bricks(const glm::ivec3& size_bricks, std::span<const BrickIndex> bricks);

/// Whole bricks that enclose every stored brick, in voxels of the bone's grid; empty for a bone without
/// bricks.
VoxelBox stored_box(const BoneContent& content);

enum class BoneChannel { fraction, stiffness, tissue };

/// A channel of a stored brick, one byte a voxel. The bone must have the channel.
std::span<const std::uint8_t, brick_voxel_count> channel_of_slot(const Bone& bone, BoneChannel channel,
                                                                 std::int32_t slot);

/// Copies a channel within `box` (which may reach past the grid) into `voxels`, x fastest; zero if no brick
/// is stored. The bone must have the channel.
void copy_channel(const Bone& bone, BoneChannel channel, const VoxelBox& box, std::span<std::uint8_t> voxels);

// Boxes round the changed voxels of each brick: uploading, shading and drawing a whole brick for the few
// voxels changed by a burr would cost more.

/// The smallest box round each change, in voxels of the grid, along x in whole groups of four; in the order
/// of the changes. A brick that is not stored has none, nor has a change of no voxel.
std::vector<VoxelBox> changed_boxes(const BoneContent& content, std::span<const BrickChange> changes);

}  // namespace osteomill
