// The values of an image from the bytes of its files, slice by slice: no more than a slice is held.
#pragma once

#include "imaging/formats/image_file.h"
#include "imaging/formats/opened_image.h"
#include "imaging/formats/voxel_data.h"

namespace osteomill {

/// Reads `data` and hands on the slices of an image of that size, as they come. Throws ImagingError as
/// read_voxel_data does, and for text that holds something else than numbers, or too few.
void read_value_slices(const VoxelData& data, const VoxelLayout& layout, const glm::ivec3& size_voxels,
                       const TakeSlice& take, const ReportProgress& report);

}  // namespace osteomill
