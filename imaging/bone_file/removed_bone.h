// Removed part of a bone, as an image: for each voxel how much of it is gone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/bone/bone.h"

namespace osteomill {

/// The first voxel (in the order of bricks) that `after` has more of than `before`; nothing if it can have
/// been carved from it. Both lie on one grid.
std::optional<glm::ivec3> first_risen_voxel(const Bone& before, const Bone& after);

/// Writes a NRRD of bytes on the bone's grid: 0 if nothing of the voxel is gone, 255 if all of it is. Written
/// a layer of bricks at a time, so that memory follows a slice, not the grid. A voxel that has risen counts
/// as 0. Throws std::invalid_argument if the grids differ, ImagingError if the file cannot be written.
void save_removed(const std::filesystem::path& path, const Bone& before, const Bone& after);

}  // namespace osteomill
