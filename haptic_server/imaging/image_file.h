// Scans in files that hold a whole volume: NRRD, NIfTI, MHA and MHD.
#pragma once

#include <filesystem>

#include "haptic_server/imaging/itk_image.h"

namespace osteomill {

struct ScanFile {
    ScanImage::Pointer image;
    bool has_orientation = true;  ///< false: the file states none; taken as LPS, identity
};

/// Throws ImagingError naming the file and the reason: not there, not a known format, cut short, not
/// three-dimensional, not scalar, fewer than two voxels along an axis, a spacing that is not above zero.
ScanFile read_image_file(const std::filesystem::path& path);

}  // namespace osteomill
