// The structures of a scene: where its tissues are, on the bone's grid, whether bone is there or not.
#pragma once

#include <filesystem>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/structure_mask.h"
#include "common/scene/scene.h"
#include "imaging/bone_file/bone_of_file.h"

namespace osteomill {

/// Structures of the tissues that name a segment; they may overlap. Throws ImagingError as read_segmentation
/// does, and for a segment that is not there or has no voxel in the bone's grid.
std::vector<Structure> segmented_structures(const Scene& scene, const std::filesystem::path& segmentation,
                                            const Grid& grid);

/// One label a voxel: that of a protected tissue before all, then of the plan's, then of the later in the
/// scene. Both arguments must outlive the result.
FillLabels label_painter(const Scene& scene, const std::vector<Structure>& structures);

/// Adds the structures of protected tissues without a segment: the voxels of the bone that bear their label.
/// Afterwards all are in the order of the tissues.
void add_structures_in_bone(const Scene& scene, const Bone& bone, std::vector<Structure>& structures);

/// The structures whose place differs from that of their label in the bone.
std::vector<Structure> structures_outside_bone_labels(const std::vector<Structure>& structures,
                                                      const Scene& scene, const Bone& bone);

}  // namespace osteomill
