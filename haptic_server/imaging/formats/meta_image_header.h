// The text header of a MetaImage (.mha, .mhd): how the image lies in the patient, and where its values lie.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "haptic_server/imaging/formats/image_file.h"

namespace osteomill {

/// A header must end within so many bytes.
inline constexpr std::size_t most_meta_image_header_bytes = 1u << 20;

struct MetaImageHeader {
    SourceImage image;  ///< without values; what had to be assumed is in its notes
    VoxelLayout voxels;
    Encoding encoding = Encoding::raw;
    std::int64_t header_size = 0;         ///< bytes before the voxels of each data file; -1: they are its end
    std::vector<std::string> data_files;  ///< empty: the voxels follow the header
    std::size_t bytes = 0;                ///< of the header
};

/// Takes the first bytes of a file apart; pure. `path` is for messages. Throws ImagingError for a header
/// that is cut off or has no end, a field that stands there twice, other than three
/// dimensions (of more than a voxel), colour, a type or an encoding that is not read, a geometry that no scan
/// has (plausible_geometry.h), a number of data files that is not that of the slices.
MetaImageHeader parse_meta_image_header(std::span<const std::uint8_t> bytes,
                                        const std::filesystem::path& path);

/// Reads the header, and finds every file of voxels. Throws ImagingError.
ImageFile open_meta_image(const std::filesystem::path& path);

}  // namespace osteomill
