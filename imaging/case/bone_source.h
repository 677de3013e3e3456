// The bone that a scene names, and how a session's remainder of it is saved.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "common/bone/ct_volume.h"
#include "common/program/progress.h"
#include "common/scene/scene.h"
#include "imaging/bone_file/hu_file.h"
#include "imaging/bone_file/removed_bone.h"
#include "imaging/bone_from_hu.h"
#include "imaging/case/structures.h"

namespace osteomill {

/// Source of a bone's slices: they are not kept, but read or made once more when needed.
struct BoneSource {
    std::string phantom;                   ///< its name; empty: a file, or a bone without CT numbers
    std::shared_ptr<const BoneFile> file;  ///< stays open, not to be confused with another of its name
    std::string hu_digest;                 ///< of the file's CT numbers when the bone was loaded
    double threshold_hu = 0.0;
    VolumesByTissue removed_before_mm3{};  ///< by the sessions before, as a saved bone tells
    std::vector<double> loaded_mm3{};      ///< by tissue, when the bone was loaded
};

struct LoadedBone {
    Bone bone;
    BoneSource source;
    std::vector<Structure> structures{};  ///< of the scene's protected tissues, in their order
    std::string doubt{};  ///< doubt about a file's CT numbers: a line, or empty (bone_of_file.h)
};

/// Makes the phantom or reads the file, slice by slice. For a file the threshold is the scene's, or the
/// file's own, or the default of 300 HU. Throws std::runtime_error with one line naming the file, also if it
/// holds no bone at all, or more than fits in `available_memory_bytes`, if known; or naming a tissue of the
/// scene that no voxel has.
LoadedBone load_bone(const Scene& scene, std::optional<std::uint64_t> available_memory_bytes = std::nullopt);

/// A bone is saved whole but without CT numbers, because its source is no longer what was loaded.
struct SavedWithoutCt : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Saves the rest of a bone together with the CT numbers of its source (carved_bone.h), which may be the file
/// that is saved over, and with how much was removed by tissue in all sessions so far. If the source can no
/// longer be read, or is not what was loaded, the bone is saved with a picture of it in their place, and then
/// SavedWithoutCt is thrown. Throws ImagingError if it cannot be written.
void save_bone(
    const std::filesystem::path& path, const BoneSource& source, const Bone& bone,
    const ReportProgress& report = [](double) {});

/// One line if the file of the source has changed since it was loaded, so that the bone will be saved without
/// its CT numbers; else empty. It checks only the file's size and times.
std::string why_source_is_lost(const BoneSource& source);

/// Whether there are CT numbers to display.
bool has_ct(const BoneSource& source, const Grid& grid);
/// The CT for display, of at most so many voxels: reads or makes all CT numbers once more. Call only if there
/// are some. Throws std::runtime_error if the source can no longer be read.
CtVolume ct_of(const BoneSource& source, std::size_t most_voxels);
/// The CT at full resolution: gives the first `slices` slices, z ascending, x fastest in each.
void read_ct(const BoneSource& source, int slices,
             const std::function<void(int z, std::span<const std::int16_t> hu)>& take);

}  // namespace osteomill
