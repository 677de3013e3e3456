// The content of a bone file: a bone, made of its CT numbers or the saved part of a carved one, and the CT
// for display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/bone/bone.h"
#include "common/bone/ct_volume.h"
#include "common/scene/stiffness_relation.h"
#include "imaging/bone_file/hu_file.h"
#include "imaging/bone_from_hu.h"

namespace osteomill {

// The bone that a bone file holds: made of its CT numbers, or the saved part of a carved one.

/// The threshold if neither scene nor file says from which HU on a voxel is bone: about the value that
/// separates trabecular bone from soft tissue in CT.
inline constexpr double default_threshold_hu = 300.0;

/// Fills `labels` with the tissues of as many voxels (whole slices, x fastest) from slice `z` on; all are 0
/// before.
using FillLabels = std::function<void(int z, std::span<std::uint8_t> labels)>;

struct BoneOfFile {
    Bone bone;
    std::shared_ptr<const BoneFile> file;  ///< stays open, not to be confused with another of its name
    std::string hu_digest;                 ///< digest of the file's CT numbers
    double threshold_hu = default_threshold_hu;
    /// A line for people on a doubt about its CT numbers, or empty: all of it is bone, or a file from
    /// elsewhere does not look like HU (hu_histogram.h).
    std::string doubt;
};

/// Reads the file slice by slice. The threshold is the one given, or the file's own, or the default. Throws
/// ImagingError with one line naming the file, also if it holds no bone at all, or more than fits in
/// `available_memory_bytes` (if known) with the copy that a session shows: as soon as that is seen.
/// Without `fill_labels` the bone is unlabelled; a carved one has the labels with which it was saved.
BoneOfFile bone_of_file(const std::filesystem::path& path, std::optional<double> threshold_hu,
                        const StiffnessRelation& relation,
                        std::optional<std::uint64_t> available_memory_bytes = std::nullopt,
                        const FillLabels& fill_labels = {});

// The CT for display, made of CT numbers that come slice by slice.

/// On the slices' own grid or, if that has more than `most_voxels`, on one as many times coarser as it must
/// be: each voxel the mean of those that it holds. Reads all slices; takes memory for the result and a slice.
CtVolume ct_overview(const HuSlices& slices, std::size_t most_voxels);

}  // namespace osteomill
