// Boxes of voxels in which a bone changed: bricks that are reported dirty are compared, layer by layer along
// each axis, with hashes of what they were. To upload, to shade and to draw again a whole brick for the few
// voxels that a burr took something from costs more than to find them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render_client/volume/textures/voxel_box.h"

namespace osteomill {

class ChangedVoxels {
  public:
    explicit ChangedVoxels(const Bone& bone);

    /// For each of these bricks in which a fraction is not what it was, the smallest box round those that are
    /// not, in voxels of the grid, along x in whole groups of four; in the order of the bricks. Bricks that
    /// are not stored have none. `bone` is the bone of the constructor, changed since. Valid until the next
    /// call.
    std::span<const VoxelBox> since_last(const Bone& bone, std::span<const BrickIndex> dirty);

  private:
    /// A layer along x is as thick as a word.
    static constexpr int word_voxels = 4;

    /// Of each layer the sum of its words, each times an odd number of its own: a multilinear hash (Carter
    /// and Wegman, "Universal classes of hash functions", 1979), to which a word adds the same product along
    /// all three axes. 64 bits, so that no two layers are ever taken for each other by chance.
    struct LayerHashes {
        std::array<std::uint64_t, brick_edge_voxels / word_voxels> x{};
        std::array<std::uint64_t, brick_edge_voxels> y{};
        std::array<std::uint64_t, brick_edge_voxels> z{};
    };

    static LayerHashes hashes_of(std::span<const std::uint8_t, brick_voxel_count> fractions);

    std::vector<LayerHashes> known_;  ///< by slot: a fourteenth of the fractions' memory
    std::vector<VoxelBox> boxes_;
};

}  // namespace osteomill
