// Preview of a scan, before an hour of import: its place, its HU, and three slices with the region that is to
// become bone, or all slices.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/bone/ct_volume.h"
#include "imaging/resampling/region.h"
#include "imaging/segmentation/segmentation.h"

namespace osteomill {

/// Reads a file that bone_import wrote without a threshold, as a whole: make it coarse. Throws ImagingError.
CtVolume whole_ct(const std::filesystem::path& bone_file);

/// Two lines: the box of the voxels' centres, patient LPS, and the smallest and largest HU.
std::string summary_of(const CtVolume& ct);

/// A PNG of the axial, coronal and sagittal slices through the region's middle (without one the scan's), a
/// pixel a voxel, from -200 HU black to 1800 white; the region's edges in orange. Left in the picture is the
/// patient's right, up is anterior in the first and superior in the others. Throws std::runtime_error where
/// it cannot be written.
void write_preview(const CtVolume& ct, const std::optional<ScanRegion>& region,
                   const std::filesystem::path& png);

/// For a program that goes through the slices itself: the same greys of every voxel, a byte each, x fastest,
/// then y, then z; and behind them, where there are segmentations, in which segment each voxel lies, counted
/// from 1 in their order, the last of several; 0: in none of the first 255. Throws std::runtime_error where
/// it cannot be written.
void write_preview_voxels(const CtVolume& ct,
                          std::span<const std::shared_ptr<const Segmentation>> segmentations,
                          const std::filesystem::path& raw);

}  // namespace osteomill
