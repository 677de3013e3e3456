// Removed part of a bone, as an image: for each voxel how much of it is gone.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/bone/bone.h"
#include "imaging/bone_file/hu_file.h"

namespace osteomill {

/// The first voxel (in the order of bricks) that `after` has more of than `before`; nothing if it can have
/// been carved from it. Both lie on one grid.
std::optional<glm::ivec3> first_risen_voxel(const Bone& before, const Bone& after);

/// Writes a NRRD of bytes on the bone's grid: 0 if nothing of the voxel is gone, 255 if all of it is. Written
/// a layer of bricks at a time, so that memory follows a slice, not the grid. A voxel that has risen counts
/// as 0. Throws std::invalid_argument if the grids differ, ImagingError if the file cannot be written.
void save_removed(const std::filesystem::path& path, const Bone& before, const Bone& after);

// Volumes of bone removed by tissue in all earlier sessions, as a saved bone states them, because removed
// bone can no longer be counted.

/// mm^3, index: tissue label; 0 for bone without one.
using VolumesByTissue = std::array<double, 256>;

inline constexpr const char* removed_key = "osteomill_removed_mm3";

/// "0:1.25 7:0.5": label and mm^3 of whatever is above 0, ascending.
std::string text_of_removed(const VolumesByTissue& removed_mm3);

/// Nothing if the file does not tell. Throws ImagingError if its values make no sense.
VolumesByTissue removed_before_mm3(const BoneFile& file);

}  // namespace osteomill
