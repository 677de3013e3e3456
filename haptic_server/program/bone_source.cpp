#include "haptic_server/program/bone_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>
#include <variant>

#include "haptic_server/imaging/carved_bone.h"
#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/phantom.h"

namespace osteomill {

namespace {

/// The source cannot give what it gave when it was loaded.
struct SourceLost : std::runtime_error {
    using std::runtime_error::runtime_error;
};

LoadedBone load_phantom(const std::string& name, const StiffnessRelation& relation) {
    std::variant<HuSlices, Bone> made = make_phantom(name);
    BoneSource source{
        .phantom = name, .file = nullptr, .hu_digest = {}, .threshold_hu = phantom_threshold_hu};
    if (auto* bone = std::get_if<Bone>(&made)) {
        source.phantom.clear();  // of which there are no CT numbers to make
        return {std::move(*bone), std::move(source)};
    }
    return {bone_from_hu(std::get<HuSlices>(made), phantom_threshold_hu, relation), std::move(source)};
}

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

LoadedBone load_file(const FileSource& named, const StiffnessRelation& relation) {
    auto file = std::make_shared<const BoneFile>(named.path);
    const double threshold_hu =
        named.threshold_hu.value_or(file->threshold_hu().value_or(default_threshold_hu));
    BoneSource source{.phantom = {}, .file = file, .hu_digest = {}, .threshold_hu = threshold_hu};
    if (is_carved(*file)) {
        RestoredBone restored = restore_carved_bone(*file);
        if (restored.bone.stored_bricks() == 0) throw ImagingError(named.path, "nothing is left of its bone");
        source.hu_digest = std::move(restored.hu_digest);
        return {std::move(restored.bone), std::move(source)};
    }
    HuReader reader(*file);
    std::int16_t highest = std::numeric_limits<std::int16_t>::min();
    Bone bone = bone_from_hu(watched(slices_of(reader, *file), highest), threshold_hu, relation);
    if (bone.stored_bricks() == 0)
        throw ImagingError(
            named.path,
            fmt::format("holds no bone: no voxel reaches {} HU, the highest has {}", threshold_hu, highest));
    source.hu_digest = reader.digest();
    return {std::move(bone), std::move(source)};
}

/// Of the file that was loaded. Throws SourceLost, at the latest with the last slice.
HuSlices slices_again(const BoneSource& source, HuReader& reader) {
    HuSlices slices = slices_of(reader, *source.file);
    const std::uint64_t voxels = voxel_count(slices.grid);
    slices.read = [read = std::move(slices.read), &reader, &source, left = voxels](
                      std::span<std::int16_t> hu, std::span<std::uint8_t> tissue) mutable {
        try {
            read(hu, tissue);
        } catch (const ImagingError& error) {
            throw SourceLost(error.what());
        }
        left -= hu.size();
        if (left == 0 && reader.digest() != source.hu_digest)
            throw SourceLost(source.file->path().string() + ": changed since it was loaded");
    };
    return slices;
}

}  // namespace

LoadedBone load_bone(const Scene& scene) {
    if (const auto* phantom = std::get_if<PhantomSource>(&scene.bone))
        return load_phantom(phantom->name, stiffness_of(scene));
    const auto& named = std::get<FileSource>(scene.bone);
    try {
        return load_file(named, stiffness_of(scene));
    } catch (const std::bad_alloc&) {
        throw ImagingError(named.path, "does not fit in memory");
    }
}

void save_bone(const std::filesystem::path& path, const BoneSource& source, const Bone& bone,
               const ReportProgress& report) {
    const std::map<std::string, std::string> keys{{threshold_key, threshold_text(source.threshold_hu)}};
    if (!source.phantom.empty())
        return save_carved_bone(path, std::get<HuSlices>(make_phantom(source.phantom)), bone, keys, report);
    // A file may itself hold no more than a coarse picture of its bone.
    if (!source.file || source.file->grid() != bone.grid()) return save_carved_bone(path, bone, keys, report);
    try {
        HuReader reader(*source.file);
        save_carved_bone(path, slices_again(source, reader), bone, keys, report);
    } catch (const SourceLost& lost) {
        save_carved_bone(path, bone, keys, report);
        throw std::runtime_error(fmt::format(
            "{}; {} is saved with CT numbers that only say where bone is left", lost.what(), path.string()));
    }
}

}  // namespace osteomill
