// Opens an image of any kind that is read: a DICOM folder or file, NRRD, NIfTI or MetaImage.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "haptic_server/imaging/progress.h"
#include "haptic_server/imaging/source_image.h"

namespace osteomill {

/// What is known before the voxels are read.
struct OpenedImage {
    SourceImage image;  ///< without values
    /// Reads image.values, with the file's own rescale (slice by slice in DICOM) applied. Throws
    /// ImagingError.
    std::function<std::vector<float>(const ReportProgress&)> read_values;
};

/// Reads headers only. `series_uid` picks a series of a DICOM folder; the largest otherwise. Throws
/// ImagingError, in one line, for all that is no three-dimensional grey image placed in the patient: a path
/// that does not exist, an unknown kind of file, a damaged header, 2 or 4 dimensions, a single slice, colour,
/// a geometry that no scan has (plausible_geometry.h), voxels that are not all there or whose checksum is
/// wrong, and what the headers, dicom_series.h and slice_geometry.h refuse.
OpenedImage open_image(const std::filesystem::path& path, const std::optional<std::string>& series_uid);

}  // namespace osteomill
