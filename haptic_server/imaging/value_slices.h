// The values of an image from the bytes of its files, slice by slice: no more than a slice is held.
#pragma once

#include "haptic_server/imaging/image_reader.h"
#include "haptic_server/imaging/meta_image_header.h"
#include "haptic_server/imaging/voxel_data.h"

namespace osteomill {

/// How the bytes are to be understood.
struct VoxelLayout {
    MetaElement element = MetaElement::int16;
    bool big_endian = false;
    std::uint64_t skipped_bytes = 0;  ///< decoded bytes before the first voxel
};

/// Reads `data` and hands on the slices of an image of that size, as they come. Throws ImagingError as
/// read_voxel_data does.
void read_value_slices(const VoxelData& data, const VoxelLayout& layout, const glm::ivec3& size_voxels,
                       const TakeSlice& take, const ReportProgress& report);

}  // namespace osteomill
