// A DICOM series as an image.
#pragma once

#include "haptic_server/imaging/dicom/dicom_series.h"
#include "haptic_server/imaging/formats/image_reader.h"

namespace osteomill {

/// Places the slices; their pixels are read later. `folder` is for messages. Throws ImagingError.
OpenedImage open_series(const std::filesystem::path& folder, const DicomSeries& series);

}  // namespace osteomill
