// Codes of voxels: the byte that selects a voxel's colour and opacity.
//
// A code is a voxel's stiffness, or the label of its tissue, or both in one: then each tissue whose stiffness
// varies has a run of codes, from its softest bone to its hardest, so that dentine differs from enamel within
// a tooth, at one byte a voxel as before.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render_client/volume/textures/empty_space.h"
#include "render_client/volume/textures/voxel_box.h"

namespace osteomill {

struct VoxelCodes {
    /// Source of the bytes; none: all bone has code 0.
    std::optional<BoneChannel> channel{};
    /// The code, by label * 256 + stiffness, if codes are of both tissue and stiffness; else empty.
    std::vector<std::uint8_t> by_tissue_and_stiffness{};

    bool exist() const { return channel.has_value() || are_of_both(); }
    bool are_of_both() const { return !by_tissue_and_stiffness.empty(); }
    /// Whether neighbours mostly have the same code, as within a tissue.
    bool are_mostly_alike() const { return are_of_both() || channel == BoneChannel::tissue; }
};

/// Copies the codes within `box` (which may reach past the grid) into `voxels`, x fastest; zero if no brick
/// is stored, and for a bone without codes. The bone must have the channels that the codes are of.
void copy_codes(const Bone& bone, const VoxelCodes& codes, const VoxelBox& box,
                std::span<std::uint8_t> voxels);

/// By block of a brick, x fastest: whether the bone in the block and within two voxels of it has at most one
/// code. A voxel of code 0 is none, and counts with any other.
std::array<bool, blocks_per_brick> blocks_of_one_code(const Bone& bone, const VoxelCodes& codes,
                                                      const glm::ivec3& brick);

/// Copies the codes within a box. A stiffness code is the largest of the voxel and its 26 neighbours: a voxel
/// at the edge of bone mixes bone and air, and its CT number makes it softer than the bone in it. With its
/// own code, colour and opacity would change from voxel to voxel of a surface.
void copy_stiffest_codes(const Bone& bone, const VoxelCodes& codes, const VoxelBox& box,
                         std::span<std::uint8_t> voxels);

}  // namespace osteomill
