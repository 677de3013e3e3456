// Where in its bricks a bone changed: bricks that are reported dirty are compared with a copy of what they
// were. It takes a byte a voxel, and is for those to whom a changed voxel costs more than comparing a brick.
#pragma once

#include <span>
#include <vector>

#include "render_client/volume/voxel_box.h"

namespace osteomill {

class ChangedVoxels {
  public:
    explicit ChangedVoxels(const Bone& bone);

    /// For each of these bricks in which a fraction is not what it was, the smallest box round those that are
    /// not, in voxels of the grid; in the order of the bricks. Bricks that are not stored have none. `bone`
    /// is the bone of the constructor, changed since. Valid until the next call.
    std::span<const VoxelBox> since_last(const Bone& bone, std::span<const BrickIndex> dirty);

  private:
    std::vector<ByteBrick> known_;  ///< by slot
    std::vector<VoxelBox> boxes_;
};

}  // namespace osteomill
