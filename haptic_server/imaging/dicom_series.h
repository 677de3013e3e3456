// A DICOM folder: which series it holds, and one of them as a volume in HU.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "haptic_server/imaging/itk_image.h"
#include "haptic_server/imaging/progress.h"

namespace osteomill {

struct DicomSeries {
    std::string uid;
    std::string description;
    std::vector<std::string> files;
};

/// The image series in a folder (not in folders below it), largest first. Throws ImagingError for a folder
/// that is not there or holds no DICOM image.
std::vector<DicomSeries> list_series(const std::filesystem::path& folder);

/// Reads a series: slices checked and ordered (slice_geometry.h), each with its own rescale slope and
/// intercept. Throws ImagingError naming the file and the reason: no pixel data, no position, orientation or
/// pixel spacing, several frames, colour, an unreadable codec, or what slice_geometry.h refuses.
ScanImage::Pointer read_series(const DicomSeries& series, const Progress& progress);

}  // namespace osteomill
