// A carved bone as files: what is left of it can be looked at in 3D Slicer, and loaded again bit for bit.
//
//   FILE.nrrd            HU of the source; -1000 where a voxel was milled away entirely
//   FILE.fraction.nrrd   what is left of each voxel, 0 to 255
//   FILE.stiffness.nrrd  stiffness codes, only of a heterogeneous bone
//   FILE.tissue.nrrd     labels, only of a labelled bone
//
// HU alone cannot give the bone back: fractions have 255 steps that no HU tells, and the stiffness of a voxel
// on the surface was taken from neighbours that may be gone. So the codes are kept as they were. Keys of
// FILE.nrrd name the other files (relative to its folder), the bone's checksum and the scale of the codes.
#pragma once

#include <filesystem>

#include "common/bone/bone.h"
#include "haptic_server/imaging/hu_file.h"
#include "haptic_server/imaging/hu_volume.h"

namespace osteomill {

/// HU of a voxel of which nothing is left.
inline constexpr std::int16_t milled_away_hu = air_hu;

/// Writes the files. `source` is the volume that `bone` was built from; its key-values go with it (the
/// threshold among them). Throws std::invalid_argument where the grids differ, ImagingError where a file
/// cannot be written.
void save_carved_bone(const std::filesystem::path& path, const HuVolume& source, const Bone& bone,
                      const std::map<std::string, std::string>& source_key_values = {});

/// Whether a bone file was written by save_carved_bone.
bool is_carved(const BoneFile& file);

/// The bone that was saved: equal checksum, and equal stiffness and labels wherever anything is left. The
/// scene's threshold and stiffness relation play no part: what was carved keeps the codes that it had.
/// `file` is what read_bone_file(path) gave. Throws ImagingError in one line where a file is missing, has
/// another grid, or the fractions do not have the checksum that was saved.
Bone restore_carved_bone(const std::filesystem::path& path, const BoneFile& file);

}  // namespace osteomill
