// Some of the voxels of a brick.
#pragma once

#include <bitset>

#include "common/bone/brick.h"

namespace osteomill {

/// By offset.
using VoxelMask = std::bitset<brick_voxel_count>;

}  // namespace osteomill
