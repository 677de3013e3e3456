#include "imaging/case/bone_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "imaging/bone_file/bone_of_file.h"
#include "imaging/bone_file/carved_bone.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

/// The source no longer gives the values that it gave when it was loaded.
struct SourceLost : std::runtime_error {
    using std::runtime_error::runtime_error;
};

LoadedBone load_phantom(const std::string& name, const StiffnessRelation& relation) {
    std::variant<HuSlices, Bone> made = make_phantom(name);
    BoneSource source{
        .phantom = name, .file = nullptr, .hu_digest = {}, .threshold_hu = phantom_threshold_hu};
    if (auto* bone = std::get_if<Bone>(&made)) {
        source.phantom.clear();  // it has no CT numbers to make
        return {std::move(*bone), std::move(source), {}, {}};
    }
    return {
        bone_from_hu(std::get<HuSlices>(made), phantom_threshold_hu, relation), std::move(source), {}, {}};
}

LoadedBone load_file(const FileSource& named, const Scene& scene,
                     std::optional<std::uint64_t> available_memory_bytes) {
    std::vector<Structure> structures;
    if (!named.segmentation.empty())
        structures = segmented_structures(scene, named.segmentation, BoneFile(named.path).grid());
    FillLabels fill_labels;
    if (!structures.empty()) fill_labels = label_painter(scene, structures);
    BoneOfFile read = bone_of_file(named.path, named.threshold_hu, stiffness_of(scene),
                                   available_memory_bytes, fill_labels);
    std::erase_if(structures, [&](const Structure& one) { return !scene.tissues[one.tissue].is_protected; });
    BoneSource source{.phantom = {},
                      .file = std::move(read.file),
                      .hu_digest = std::move(read.hu_digest),
                      .threshold_hu = read.threshold_hu};
    source.removed_before_mm3 = removed_before_mm3(*source.file);
    return {std::move(read.bone), std::move(source), std::move(structures), std::move(read.doubt)};
}

VolumesByTissue removed_so_far_mm3(const BoneSource& source, const Bone& bone) {
    VolumesByTissue removed_mm3 = source.removed_before_mm3;
    const std::vector<double> left_mm3 = bone_volume_by_tissue_mm3(bone);
    for (std::size_t label = 0; label < source.loaded_mm3.size(); ++label)
        removed_mm3[label] += source.loaded_mm3[label] - (label < left_mm3.size() ? left_mm3[label] : 0.0);
    return removed_mm3;
}

/// A reader at the first voxel of the loaded file. Throws SourceLost, since the data before the voxels of a
/// bone that was carved before are read here.
HuReader reader_again(const BoneSource& source) {
    try {
        return HuReader(*source.file);
    } catch (const std::runtime_error& error) {
        throw SourceLost(error.what());
    }
}

/// Slices of the loaded file. Throws SourceLost, at the latest with the last slice.
HuSlices slices_again(const BoneSource& source, HuReader& reader) {
    HuSlices slices = slices_of(reader, *source.file);
    const std::uint64_t voxels = voxel_count(slices.grid);
    slices.read = [read = std::move(slices.read), &reader, &source, left = voxels](
                      std::span<std::int16_t> hu, std::span<std::uint8_t> tissue) mutable {
        try {
            read(hu, tissue);
        } catch (const std::runtime_error& error) {
            throw SourceLost(error.what());
        }
        left -= hu.size();
        if (left == 0 && reader.digest() != source.hu_digest)
            throw SourceLost(source.file->path().string() + ": changed since it was loaded");
    };
    return slices;
}

/// A tissue that an earlier session removed to the last voxel is not missing.
void require_every_tissue(const Scene& scene, const LoadedBone& loaded) {
    const auto* planned = scene.plan ? std::get_if<TissueRegion>(&scene.plan->region) : nullptr;
    for (const Tissue& tissue : scene.tissues) {
        const std::vector<double>& volumes_mm3 = loaded.source.loaded_mm3;
        const bool in_bone = tissue.label < volumes_mm3.size() && volumes_mm3[tissue.label] > 0.0;
        const bool is_planned = planned != nullptr && tissue.name == planned->tissue;
        if (is_planned && !in_bone && loaded.source.removed_before_mm3[tissue.label] == 0.0)
            throw std::runtime_error(
                fmt::format("scene \"{}\": no voxel of the bone is of the plan's tissue \"{}\"; there is "
                            "nothing to remove (a protected tissue goes before it where both are)",
                            scene.name, tissue.name));
        if (in_bone || !tissue.segment.empty() || loaded.source.removed_before_mm3[tissue.label] > 0.0)
            continue;
        throw std::runtime_error(
            fmt::format("scene \"{}\": no voxel of the bone is of its tissue \"{}\" (label {}); take it out "
                        "of [[tissues]], or "
                        "give it a 'segment' of [bone] segmentation",
                        scene.name, tissue.name, tissue.label));
    }
}

/// Calls `use` with the slices from which the bone was built, made or read once more.
template <typename Use>
auto with_slices(const BoneSource& source, const Use& use) {
    if (!source.phantom.empty()) return use(std::get<HuSlices>(make_phantom(source.phantom)));
    HuReader reader(*source.file);
    return use(slices_again(source, reader));
}

}  // namespace

LoadedBone load_bone(const Scene& scene, std::optional<std::uint64_t> available_memory_bytes) {
    const auto* phantom = std::get_if<PhantomSource>(&scene.bone);
    LoadedBone loaded = phantom != nullptr
                            ? load_phantom(phantom->name, stiffness_of(scene))
                            : load_file(std::get<FileSource>(scene.bone), scene, available_memory_bytes);
    loaded.source.loaded_mm3 = bone_volume_by_tissue_mm3(loaded.bone);
    require_every_tissue(scene, loaded);
    add_structures_in_bone(scene, loaded.bone, loaded.structures);
    return loaded;
}

void save_bone(const std::filesystem::path& path, const BoneSource& source, const Bone& bone,
               const ReportProgress& report) {
    const std::map<std::string, std::string> keys{
        {threshold_key, threshold_text(source.threshold_hu)},
        {removed_key, text_of_removed(removed_so_far_mm3(source, bone))}};
    if (!source.phantom.empty())
        return save_carved_bone(path, std::get<HuSlices>(make_phantom(source.phantom)), bone, keys, report);
    // A file may itself hold no more than a coarse picture of its bone.
    if (!source.file || source.file->grid() != bone.grid()) return save_carved_bone(path, bone, keys, report);
    try {
        HuReader reader = reader_again(source);
        save_carved_bone(path, slices_again(source, reader), bone, keys, report);
    } catch (const SourceLost& lost) {
        save_carved_bone(path, bone, keys, report);
        throw SavedWithoutCt(fmt::format("{}; {} is saved with CT numbers that only say where bone is left",
                                         lost.what(), path.string()));
    }
}

std::string why_source_is_lost(const BoneSource& source) {
    if (!source.file || !source.file->has_changed()) return {};
    return fmt::format(
        "{}: was written to since it was loaded; unless its CT numbers are the same, the bone "
        "will be saved with some that only say where bone is left",
        source.file->path().string());
}

bool has_ct(const BoneSource& source, const Grid& grid) {
    return !source.phantom.empty() || (source.file && source.file->grid() == grid);
}

CtVolume ct_of(const BoneSource& source, std::size_t most_voxels) {
    return with_slices(source, [&](const HuSlices& slices) { return ct_overview(slices, most_voxels); });
}

void read_ct(const BoneSource& source, int count,
             const std::function<void(int z, std::span<const std::int16_t> hu)>& take) {
    with_slices(source, [&](const HuSlices& slices) {
        const glm::ivec3& size = slices.grid.size_voxels;
        std::vector<std::int16_t> hu(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
        std::vector<std::uint8_t> tissue(slices.labelled ? hu.size() : 0);
        for (int z = 0; z < std::min(count, size.z); ++z) {
            slices.read(hu, tissue);
            take(z, hu);
        }
    });
}

}  // namespace osteomill
