// Distance map of empty space, which rays skip: for each block of 4^3 voxels, the distance of the nearest
// block that can hold a piece of the bone's surface.
//
// A block can hold a surface point if one of the voxels that trilinear interpolation reads within it (its own
// and a border of one) is at least half full. Distances are counted in blocks, as a king moves (Chebyshev):
// all blocks closer than the distance are empty. A block that has become empty has distance 1 from then on,
// and its neighbours keep theirs: carving leaves distances shorter than they might be, never longer. If bone
// comes back (undo, a recording played backwards), all distances that it affects are shortened at once. The
// method is that of Cohen and Sheffer, "Proximity clouds" (1994).
//
// A second map holds each block's mean fraction, a coarse copy of the bone, for ambient occlusion.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/bone/brick.h"
#include "common/bone/brick_change.h"
#include "render_client/volume/steps.h"
#include "render_client/volume/textures/voxel_box.h"

namespace osteomill {

// Summary of a brick as 4^3 blocks of 4^3 voxels: the sides of a block that bone reaches, and its mean
// fraction. The maps of empty space are made of these, brick by brick.

inline constexpr int block_edge_voxels = 4;
inline constexpr std::size_t blocks_per_brick = 64;

/// Parts of a block that hold a voxel that is at least half full. Bit (dx + 1) + 3 (dy + 1) + 9 (dz + 1),
/// each of d from -1 to 1: the voxels that touch the neighbour in that direction, i.e. the whole block (0, 0,
/// 0), a face, an edge or a corner. Trilinear interpolation within that neighbour reads just those voxels.
using BlockReach = std::uint32_t;

/// By block of the brick, x fastest.
struct BrickSummary {
    std::array<BlockReach, blocks_per_brick> reach{};
    std::array<std::uint8_t, blocks_per_brick> mean_fraction{};  ///< rounded down
};

BrickSummary summary_of_brick(BrickFractions fractions);

/// Offset of the neighbour that a bit of BlockReach (0 to 26) stands for.
constexpr glm::ivec3 neighbour_of_bit(int bit) {
    return {bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1};
}

/// Both maps cover the box and one block beyond it on every side: block (0, 0, 0) ends where the box begins.
class EmptySpace {
  public:
    /// `box` is aligned to bricks (see stored_box).
    EmptySpace(const Bone& bone, const VoxelBox& box);
    /// Without contents; fill() enters the bone.
    explicit EmptySpace(const VoxelBox& box);

    /// Enters all of the bone, once. Pass bricks that change meanwhile to update afterwards.
    Steps fill(const Bone& bone);

    /// Brings the maps up to date after fractions were lowered or raised. Bricks that are not
    /// stored change nothing. Returns boxes of blocks, none of which overlap, that hold every change; they
    /// are valid until the next update.
    std::span<const VoxelBox> update(const Bone& bone, std::span<const BrickChange> changes);

    const glm::ivec3& size_blocks() const { return size_blocks_; }
    /// Place of a block in both maps.
    std::size_t index(const glm::ivec3& block) const {
        return (static_cast<std::size_t>(block.z) * size_blocks_.y + block.y) * size_blocks_.x + block.x;
    }
    /// The block with that number in the summary of a brick, a position in bricks.
    glm::ivec3 block_of(const glm::ivec3& brick, std::size_t number) const {
        return (brick * brick_edge_voxels - box_.first) / block_edge_voxels + 1 +
               glm::ivec3(number & 3, number >> 2 & 3, static_cast<int>(number >> 4));
    }
    const std::vector<std::uint8_t>& distance() const { return distance_; }
    const std::vector<std::uint8_t>& mean_fraction() const { return mean_fraction_; }

  private:
    void take_in(const Bone& bone, const glm::ivec3& brick, std::int32_t slot);
    Steps spread_everywhere();
    void spread_from_reached();
    void mark_changed(const glm::ivec3& block);

    VoxelBox box_;
    glm::ivec3 size_blocks_;
    std::vector<std::uint8_t> distance_;
    std::vector<std::uint8_t> mean_fraction_;

    /// Number of the 27 blocks around (and including) a block that reach into its interpolation, and the
    /// reach of each block by its brick's slot: a change then costs work only where it is.
    std::vector<std::uint8_t> reached_by_;
    std::vector<std::array<BlockReach, blocks_per_brick>> reach_of_slot_;

    // State of the update under way.
    std::vector<glm::ivec3> newly_reached_;
    std::vector<glm::ivec3> newly_free_;
    std::vector<VoxelBox> changed_tiles_;
    std::vector<std::uint8_t> tile_is_changed_;
    glm::ivec3 size_tiles_;
};

}  // namespace osteomill
