// The CT for display, made of CT numbers that come slice by slice.
#pragma once

#include <cstddef>

#include "common/bone/ct_volume.h"
#include "imaging/hu_slices.h"

namespace osteomill {

/// On the slices' own grid or, if that has more than `most_voxels`, on one as many times coarser as it must
/// be: each voxel the mean of those that it holds. Reads all slices; takes memory for the result and a slice.
CtVolume ct_overview(const HuSlices& slices, std::size_t most_voxels);

}  // namespace osteomill
