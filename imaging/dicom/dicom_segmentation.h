// A DICOM segmentation (SEG) as a label map with layers, its segments as in 3D Slicer's .seg.nrrd.
#pragma once

#include <filesystem>

#include "imaging/formats/source_image.h"

namespace osteomill {

/// Whether the file is one, and can be parsed.
bool is_dicom_segmentation(const std::filesystem::path& path);

/// Binary, fractional (from half of the most on) and label map, of 1, 8 or 16 bits, the latter compressed or
/// not; frames in any order, those of empty slices left out as writers do. Throws ImagingError for a file
/// that is cut off, frames without position or segment, and slices that do not lie on one lattice.
OpenedImage open_dicom_segmentation(const std::filesystem::path& path);

}  // namespace osteomill
