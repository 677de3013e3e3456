// Clears what lies far from bone, so that a bone file is small.
#pragma once

#include "haptic_server/imaging/hu_volume.h"

namespace osteomill {

/// HU within this many voxels of bone stay as they are: what the surface's gradient and cover are made from.
inline constexpr int kept_voxels_around_bone = 2;

/// Sets every voxel that is further than kept_voxels_around_bone (along any axis) from one that reaches the
/// threshold to air, -1000 HU. Returns how many voxels reach it.
std::uint64_t clear_far_from_bone(HuVolume& volume, double threshold_hu);

}  // namespace osteomill
