// A carved bone as one file: 3D Slicer can show the remaining bone, and it can be loaded again bit for bit.
//
// HU alone cannot give the bone back: fractions have 255 levels that no HU tells, and the stiffness of a
// voxel on the surface was taken from neighbours that may be gone. So the codes are kept as they were, in the
// same file, since two files can be parted, and cannot be renamed at once. NRRD has a place for them: "byte
// skip" says how many decoded bytes of the gzip stream stand before the voxels, and readers (teem, with which
// ITK and 3D Slicer read, and pynrrd) skip them.
//
//   before the voxels   for each brick of which anything is left, ascending: its index (32 bits, little
//                       endian), 4096 fractions, 4096 stiffness codes if the bone is heterogeneous, 4096
//                       labels if it is labelled
//   voxels              HU of the source; -1000 where a voxel was milled away entirely. Without a source, a
//                       picture of the bone, whose voxels may be longer than the bone's
//   keys                how many bricks, the scale of the codes, the bone's checksum, its grid where that is
//                       not the voxels', and a digest of each channel besides those of every bone file
//                       (hu_file.h)
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "common/bone/bone.h"
#include "common/program/progress.h"
#include "imaging/bone_file/hu_file.h"
#include "imaging/bone_from_hu.h"

namespace osteomill {

/// HU of a voxel of which nothing is left.
inline constexpr std::int16_t milled_away_hu = air_hu;

/// Writes the file beside `path` and switches to it at once. `source` gives the slices from which `bone` was
/// built; `key_values` go with it (the threshold among them). Throws std::invalid_argument if the grids
/// differ, ImagingError if the file cannot be written; an older file of that name is then unchanged, also if
/// `source` throws.
void save_carved_bone(
    const std::filesystem::path& path, const HuSlices& source, const Bone& bone,
    const std::map<std::string, std::string>& key_values = {}, const ReportProgress& report = [](double) {});

/// The same for a bone that no CT numbers were made for, or whose source is gone: the voxels are a picture of
/// it, on a grid of longer voxels if its own is large (picture_grid).
void save_carved_bone(
    const std::filesystem::path& path, const Bone& bone, std::map<std::string, std::string> key_values = {},
    const ReportProgress& report = [](double) {});

struct RestoredBone {
    Bone bone;
    std::string hu_digest;  ///< digest of the CT numbers beside it
};

/// Whether a bone file holds a carved bone.
bool is_carved(const BoneFile& file);

/// The bone that was saved: equal checksum, and equal stiffness and labels wherever anything is left. The
/// scene's threshold and stiffness relation play no part: a carved bone keeps its codes. Reads all of the
/// file, the HU, too. Throws ImagingError in one line that names the channel if a digest is not the one
/// saved, and for files of 0.1.
RestoredBone restore_carved_bone(const BoneFile& file);

// CT numbers that only show the remaining bone, for a bone without CT numbers, or whose source is gone.

/// The grid of a bone's picture: the bone's own if that has up to 2^25 voxels; else one of voxels 2, 4, 8 or
/// 16 times as long: more detail is of no use for display, and a head of 2048^3 would take most of a minute.
Grid picture_grid(const Grid& bone);

/// From -1000 where there is no bone to 1600 (the reference bone) where all of a voxel is left; a longer
/// voxel holds the mean. For display only. `bone` must outlive it.
HuSlices picture_of(const Bone& bone);

}  // namespace osteomill
