// A DICOM folder or file as an image.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "imaging/formats/source_image.h"

namespace osteomill {

/// Places the slices of the series requested, or else of the largest; their pixels are read later. The notes
/// name the other contents of the folder. Labels may also be a segmentation (SEG). Throws ImagingError.
OpenedImage open_dicom_folder(const std::filesystem::path& folder,
                              const std::optional<std::string>& series_uid, ImagePurpose purpose);
OpenedImage open_dicom_file(const std::filesystem::path& path, ImagePurpose purpose);

}  // namespace osteomill
