// Where rays need not look: for each block of 4^3 voxels, how far away the nearest block is that can hold a
// piece of the bone's surface.
//
// A block can hold a surface point if one of the voxels that trilinear interpolation reads within it (its own
// and a border of one) is at least half full. Distances are counted in blocks, as a king moves (Chebyshev):
// all blocks closer than the distance are empty. Carving keeps them true; they are then only shorter than
// they might be, except that a block that has become empty itself is marked as such (distance 1) at once.
// The method is that of Cohen and Sheffer, "Proximity clouds" (1994).
//
// A second map holds each block's mean fraction, a coarse copy of the bone, for ambient occlusion.
#pragma once

#include <cstdint>
#include <vector>

#include "render_client/volume/voxel_box.h"

namespace osteomill {

inline constexpr int block_edge_voxels = 4;

/// Both maps cover the box and one block beyond it on every side: block (0, 0, 0) ends where the box begins.
class EmptySpace {
  public:
    /// `box` is aligned to bricks (see stored_box).
    EmptySpace(const Bone& bone, const VoxelBox& box);

    /// Brings the maps up to date after voxels of one brick (its place in the bone's grid) were lowered.
    /// Returns the blocks that may have changed. A brick outside the box changes nothing.
    VoxelBox update_after_carving(const Bone& bone, const glm::ivec3& brick);

    const glm::ivec3& size_blocks() const { return size_blocks_; }
    const std::vector<std::uint8_t>& distance() const { return distance_; }
    const std::vector<std::uint8_t>& mean_fraction() const { return mean_fraction_; }

  private:
    void classify(const Bone& bone, const VoxelBox& blocks);
    void spread_distances();
    std::size_t index(const glm::ivec3& block) const {
        return (static_cast<std::size_t>(block.z) * size_blocks_.y + block.y) * size_blocks_.x + block.x;
    }

    VoxelBox box_;
    glm::ivec3 size_blocks_;
    std::vector<std::uint8_t> distance_;
    std::vector<std::uint8_t> mean_fraction_;
};

/// Copies a box of blocks out of one of the maps, x fastest: what an update of its texture takes.
std::vector<std::uint8_t> copy_blocks(const std::vector<std::uint8_t>& map, const glm::ivec3& size_blocks,
                                      const VoxelBox& blocks);

}  // namespace osteomill
