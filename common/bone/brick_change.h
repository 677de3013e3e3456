// Changed voxels of one brick: what says, from the carve to the picture, where the bone has changed.
#pragma once

#include <bitset>

#include "common/bone/brick.h"

namespace osteomill {

/// Some of the voxels of a brick, by offset.
using VoxelMask = std::bitset<brick_voxel_count>;

struct BrickChange {
    BrickIndex brick = 0;
    VoxelMask voxels{};

    bool operator==(const BrickChange&) const = default;
};

}  // namespace osteomill
