// CT numbers that only show the remaining bone, for a bone without CT numbers, or whose source is gone.
#pragma once

#include "common/bone/bone.h"
#include "imaging/hu_slices.h"

namespace osteomill {

/// The grid of a bone's picture: the bone's own if that has up to 2^25 voxels; else one of voxels 2, 4, 8 or
/// 16 times as long: more detail is of no use for display, and a head of 2048^3 would take most of a minute.
Grid picture_grid(const Grid& bone);

/// From -1000 where there is no bone to 1600 (the reference bone) where all of a voxel is left; a longer
/// voxel holds the mean. For display only. `bone` must outlive it.
HuSlices picture_of(const Bone& bone);

}  // namespace osteomill
