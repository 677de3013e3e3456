// What 0.1 saved of a carved bone: several files, which this version reads and no longer writes.
//
//   FILE.nrrd            HU of the source; -1000 where a voxel was milled away entirely
//   FILE.fraction.nrrd   what is left of each voxel, 0 to 255
//   FILE.stiffness.nrrd  stiffness codes, only of a heterogeneous bone
//   FILE.tissue.nrrd     labels, only of a labelled bone
//
// Keys of FILE.nrrd name the other files (relative to its folder), the bone's checksum and the scale of the
// codes. Labels and codes have no digest there; of the fractions the bone's checksum is one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "imaging/bone_file/hu_file.h"

namespace osteomill {

// Keys that later versions have, too.
inline constexpr const char* bone_checksum_key = "osteomill_bone_checksum";
inline constexpr const char* stiffness_per_code_key = "osteomill_stiffness_per_code";
inline constexpr const char* homogeneous_stiffness_key = "osteomill_homogeneous_stiffness";

std::string bone_checksum_text(const Bone& bone);
/// Throws ImagingError where the bone has not the checksum that the file's key says.
void require_bone_checksum(const BoneFile& file, const Bone& bone);
/// A number above 0. Throws ImagingError, naming the key.
double number_of_key(const BoneFile& file, const char* key);

struct RestoredBone {
    Bone bone;
    std::string hu_digest;  ///< of the CT numbers beside it
};

bool is_saved_set(const BoneFile& file);

/// Reads FILE.nrrd to its end, too, so that gzip's CRC covers every file. Throws ImagingError in one line for
/// a file that is missing, damaged or of another grid, and for fractions of another carving.
RestoredBone restore_saved_set(const BoneFile& file);

/// The files that a set under this name holds besides FILE.nrrd: those that its header names, with the names
/// that 0.1 gave them. None where there is no such set.
std::vector<std::filesystem::path> files_of_saved_set(const std::filesystem::path& path);

}  // namespace osteomill
