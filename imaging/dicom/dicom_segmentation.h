// A DICOM segmentation (SEG) as a label map with layers, its segments in the words of 3D Slicer's .seg.nrrd.
#pragma once

#include <filesystem>

#include "imaging/formats/image_reader.h"

namespace osteomill {

/// Whether the file is one: Segmentation Storage or Label Map Segmentation Storage.
bool is_dicom_segmentation(const std::filesystem::path& path);

/// Binary, fractional (from half of the most on) and label map; frames in any order, those of empty slices
/// left out as writers do. Throws ImagingError for a file that is cut off, compressed pixels, frames without
/// position or segment, and slices that do not lie on one lattice.
OpenedImage open_dicom_segmentation(const std::filesystem::path& path);

}  // namespace osteomill
