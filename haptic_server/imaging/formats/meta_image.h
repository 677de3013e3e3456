// The voxels of a MetaImage, in its own file or in others.
#pragma once

#include <filesystem>

#include "haptic_server/imaging/formats/meta_image_header.h"
#include "haptic_server/imaging/formats/voxel_data.h"

namespace osteomill {

struct MetaImage {
    MetaImageHeader header;
    VoxelData data;
};

/// Reads the header, counts and sizes every file of voxels. Throws ImagingError. What had to be assumed joins
/// the notes of header.image.
MetaImage open_meta_image(const std::filesystem::path& path);

}  // namespace osteomill
