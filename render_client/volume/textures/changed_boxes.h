// Boxes round the changed voxels of each brick: uploading, shading and drawing a whole brick for the few
// voxels changed by a burr would cost more.
#pragma once

#include <span>
#include <vector>

#include "common/bone/brick_change.h"
#include "render_client/volume/textures/voxel_box.h"

namespace osteomill {

/// The smallest box round each change, in voxels of the grid, along x in whole groups of four; in the order
/// of the changes. A brick that is not stored has none, nor has a change of no voxel.
std::vector<VoxelBox> changed_boxes(const BoneContent& content, std::span<const BrickChange> changes);

}  // namespace osteomill
