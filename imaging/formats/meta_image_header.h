// The text header of a MetaImage (.mha, .mhd): how the image lies in the patient, and where its values lie.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "imaging/formats/image_file.h"

namespace osteomill {

/// A header must end within so many bytes.
inline constexpr std::size_t most_meta_image_header_bytes = 1u << 20;

/// Takes the first bytes of a file apart; pure. `path` is for messages. Throws ImagingError for a header
/// that is cut off or has no end, a field that stands there twice, other than three
/// dimensions (of more than a voxel), colour, a type or an encoding that is not read, a geometry that no scan
/// has (plausible_geometry.h), a number of data files that is not that of the slices.
ImageHeader parse_meta_image_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// Reads the header. Throws ImagingError.
ImageHeader open_meta_image(const std::filesystem::path& path);

}  // namespace osteomill
