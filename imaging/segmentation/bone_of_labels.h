// CT numbers for a patient who has labels and no CT: all segments that are bone as one image, from which a
// bone is imported as from a scan. Between the labels' voxels its surface then runs smoothly, and two bones
// side by side leave no gap.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "imaging/formats/source_image.h"
#include "imaging/segmentation/segmentation.h"

namespace osteomill {

/// Halfway from the air's HU to the bone's: the surface.
inline constexpr double threshold_of_labels_hu = 300.0;

/// 1600 HU in every voxel of a segment for which `is_bone`, -1000 elsewhere. All maps have the geometry of
/// the first; throws ImagingError, naming both files, if one has not, and if no segment is bone.
OpenedImage bone_of_labels(const std::vector<std::shared_ptr<const Segmentation>>& maps,
                           const std::function<bool(const Segment&)>& is_bone);

}  // namespace osteomill
