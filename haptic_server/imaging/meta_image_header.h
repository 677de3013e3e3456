// The text header of a MetaImage (.mha, .mhd). ITK's reader fills up a file that was cut off, and a spacing
// of zero makes it fail without saying why.
#pragma once

#include <cstdint>
#include <filesystem>

namespace osteomill {

/// Throws ImagingError where the spacing holds a zero or something that is not a number.
void require_meta_image_spacing(const std::filesystem::path& path);

/// Throws ImagingError where the voxels' bytes, `voxel_bytes` when not compressed, are not all there.
void require_whole_meta_image(const std::filesystem::path& path, std::uint64_t voxel_bytes);

}  // namespace osteomill
