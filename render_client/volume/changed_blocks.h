// Where in its bricks a bone changed: bricks that are reported dirty are compared, block by block (of 4^3
// voxels, see block_summary.h), with hashes of what they were. To upload, to shade and to draw again a whole
// brick for the few blocks that a burr took something from costs more than to find them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render_client/volume/block_summary.h"
#include "render_client/volume/voxel_box.h"

namespace osteomill {

class ChangedBlocks {
  public:
    explicit ChangedBlocks(const Bone& bone);

    /// For each of these bricks in which a fraction is not what it was, the smallest box of whole blocks
    /// round those that are not, in voxels of the grid; in the order of the bricks. Bricks that are not
    /// stored have none. `bone` is the bone of the constructor, changed since. Valid until the next call.
    std::span<const VoxelBox> since_last(const Bone& bone, std::span<const BrickIndex> dirty);

  private:
    /// XXH3 of each block's fractions: 64 bits, so that no two are ever taken for each other by chance.
    using BlockHashes = std::array<std::uint64_t, blocks_per_brick>;

    static BlockHashes hashes_of(std::span<const std::uint8_t, brick_voxel_count> fractions);

    std::vector<BlockHashes> known_;  ///< by slot: an eighth of the fractions' memory
    std::vector<VoxelBox> boxes_;
};

}  // namespace osteomill
