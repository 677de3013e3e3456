// A bone in an HDF5 file, as arrays indexed [i, j, k]. Chunks are bricks; those without bone take no space.
#pragma once

#include <string>

#include "analysis/hdf5/hdf5_file.h"
#include "common/bone/bone.h"

namespace osteomill {

/// Writes group/fraction, and group/stiffness and group/tissue if the bone has them, bytes as in the bone,
/// and the grid as attributes of the group. Throws as Hdf5File does.
void write_bone(Hdf5File& file, const std::string& group, const Bone& bone);

}  // namespace osteomill
