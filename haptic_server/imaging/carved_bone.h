// A carved bone, saved and taken up again exactly. FILE.nrrd holds HU for people and other programs, air
// where a voxel was milled away whole. Beside it stand the bone's own channels, one byte a voxel:
// FILE.fraction.nrrd, and FILE.stiffness.nrrd and FILE.tissue.nrrd where the bone has them. FILE.nrrd's
// header names them and the checksum.
#pragma once

#include <filesystem>

#include "haptic_server/imaging/hu_file.h"

namespace osteomill {

/// Writes the files. `source` is the volume that the bone was built from. Throws ImagingError where they
/// cannot be written, `path` does not end in .nrrd, or `source` is of another grid than the bone.
void save_carved_bone(const std::filesystem::path& path, const HuVolume& source, double threshold_hu,
                      const Bone& bone);

/// The bone of a file: as bone_from_hu makes it, or where the file is a carved bone, from its channels, equal
/// to what was saved. Throws ImagingError where a channel's file is missing or does not belong.
Bone bone_from_file(const std::filesystem::path& path, const HuFile& file, double threshold_hu,
                    const StiffnessRelation& relation);

}  // namespace osteomill
