#include "haptic_server/imaging/bone_of_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "haptic_server/imaging/carved_bone.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

/// The file's slices, and the highest HU that came by.
HuSlices watched(HuSlices slices, std::int16_t& highest) {
    return {.grid = slices.grid,
            .labelled = slices.labelled,
            .read = [read = std::move(slices.read), &highest](std::span<std::int16_t> hu,
                                                              std::span<std::uint8_t> tissue) {
                read(hu, tissue);
                std::int16_t here = highest;
                for (const std::int16_t value : hu) here = std::max(here, value);
                highest = here;
            }};
}

BoneOfFile read(const std::filesystem::path& path, std::optional<double> threshold,
                const StiffnessRelation& relation) {
    auto file = std::make_shared<const BoneFile>(path);
    const double threshold_hu = threshold.value_or(file->threshold_hu().value_or(default_threshold_hu));
    if (is_carved(*file)) {
        RestoredBone restored = restore_carved_bone(*file);
        if (restored.bone.stored_bricks() == 0) throw ImagingError(path, "nothing is left of its bone");
        return {.bone = std::move(restored.bone),
                .file = std::move(file),
                .hu_digest = std::move(restored.hu_digest),
                .threshold_hu = threshold_hu};
    }
    HuReader reader(*file);
    std::int16_t highest = std::numeric_limits<std::int16_t>::min();
    Bone bone = bone_from_hu(watched(slices_of(reader, *file), highest), threshold_hu, relation);
    if (bone.stored_bricks() == 0)
        throw ImagingError(path, fmt::format("holds no bone: no voxel reaches {} HU, the highest has {}",
                                             threshold_hu, highest));
    return {.bone = std::move(bone),
            .file = std::move(file),
            .hu_digest = reader.digest(),
            .threshold_hu = threshold_hu};
}

}  // namespace

BoneOfFile bone_of_file(const std::filesystem::path& path, std::optional<double> threshold_hu,
                        const StiffnessRelation& relation) {
    try {
        return read(path, threshold_hu, relation);
    } catch (const std::bad_alloc&) {
        throw ImagingError(path, "does not fit in memory");
    }
}

}  // namespace osteomill
