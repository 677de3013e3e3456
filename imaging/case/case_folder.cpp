#include "imaging/case/case_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "common/files/atomic_file.h"
#include "common/files/inside_folder.h"
#include "common/scene/material.h"
#include "common/scene/nearest_name.h"
#include "common/scene/scene.h"
#include "common/scene/scene_file.h"
#include "common/text/foreign_text.h"
#include "imaging/case/bone_source.h"
#include "imaging/case/case_card.h"
#include "imaging/case/case_trust.h"
#include "imaging/case/scene_on_bone.h"
#include "imaging/formats/image_reader.h"
#include "imaging/phantoms/phantom.h"
#include "imaging/segmentation/bone_of_labels.h"
#include "imaging/segmentation/segment_structure.h"
#include "imaging/segmentation/segmentation_file.h"

namespace osteomill {

namespace {

constexpr const char* scene_name = "case.toml";
constexpr const char* segmentation_name = "segmentation.seg.nrrd";
constexpr const char* picture_name = "picture.png";
constexpr std::size_t most_tissues = 255;
/// Colours of segments to which the file gives none.
constexpr std::array<std::array<std::uint8_t, 3>, 6> palette{
    {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {213, 94, 0}, {204, 121, 167}}};
constexpr const char* preface =
    "# A case of Osteomill: a scene file (docs/scenes.md). Paths are relative to this folder.\n"
    "# Set protected = true for what must not be touched; warn_mm is then the distance from the burr at "
    "which\n"
    "# to warn, in mm. What its CT numbers say of a tissue's stiffness, stiffness_factor multiplies, and\n"
    "# relative_stiffness or material replaces; no burr takes what has cuttable = false.\n"
    "# The last line tells damage from what was written; without it, or once you have edited this file, "
    "each\n"
    "# session says that it is unsigned.\n\n";

/// Replaces a folder by the label maps in it, by name.
std::vector<std::filesystem::path> label_maps(const std::vector<std::filesystem::path>& paths) {
    std::vector<std::filesystem::path> maps;
    std::error_code failed;
    for (const auto& path : paths) {
        std::vector<std::filesystem::path> found;
        if (std::filesystem::is_directory(path, failed))
            for (const auto& entry : std::filesystem::directory_iterator(path))
                if (entry.is_regular_file(failed) && is_image_name(entry.path()))
                    found.push_back(entry.path());
        std::ranges::sort(found);
        if (found.empty()) found = {path};
        maps.insert(maps.end(), found.begin(), found.end());
    }
    return maps;
}

std::shared_ptr<const Segmentation> read(const std::filesystem::path& path, const CaseParts& parts) {
    Segmentation segmentation = read_segmentation(path, parts.stack_spacing_mm);
    if (parts.colours && segmentation.is_plain_map)
        name_segments(segmentation, read_colour_table(*parts.colours));
    return std::make_shared<const Segmentation>(std::move(segmentation));
}

/// Names of all segmentations' segments; refuses a name that occurs twice.
std::set<std::string> segment_names(const BegunCase& begun) {
    std::set<std::string> names;
    for (const auto& segmentation : begun.segmentations)
        for (const Segment& segment : segmentation->segments) {
            const auto refuse = [&](const char* why) {
                throw std::runtime_error(fmt::format("{}: has a segment \"{}\", {}; rename it",
                                                     segmentation->path.string(), segment.name, why));
            };
            if (is_name_of_sum(segment.name)) refuse("as reports call a sum");
            if (!names.insert(segment.name).second) refuse("as one before has");
        }
    return names;
}

const Material* material_named(const std::string& name) {
    std::vector<std::string> names{soft_material};
    for (const Material& material : shipped_materials()) {
        if (material.name == name) return &material;
        names.push_back(material.name);
    }
    if (name == soft_material) return nullptr;
    const std::optional<std::string> nearest = nearest_name(name, names);
    throw std::runtime_error(
        nearest ? fmt::format("--material: '{}' is none; did you mean \"{}\"?", name, *nearest)
                : fmt::format("--material: '{}' is none; there are {}", name, fmt::join(names, ", ")));
}

/// nullptr: its CT numbers decide, or it is no bone.
const Material* material_of(const std::string& segment, const CaseParts& parts, bool is_of_labels) {
    const auto said = parts.materials.find(segment);
    if (said != parts.materials.end()) return material_named(said->second);
    return is_of_labels ? material_of_segment(segment) : nullptr;
}

/// The name as the files spell it.
std::string known_name(const std::string& option, const std::string& name,
                       const std::set<std::string>& known) {
    const std::vector<std::string> names(known.begin(), known.end());
    if (const auto same = same_name(name, names)) return *same;
    const std::optional<std::string> nearest = nearest_name(name, names);
    throw std::runtime_error(fmt::format("{}: no segment is called \"{}\"{}", option, name,
                                         nearest ? fmt::format("; did you mean \"{}\"?", *nearest)
                                         : names.empty()
                                             ? "; give --segmentation"
                                             : fmt::format("; there are {}", fmt::join(names, ", "))));
}

/// A structure of a case, and its material.
struct CaseStructure {
    NamedStructure structure{};
    const Material* material = nullptr;
};

/// Structures in the bone's box.
std::vector<CaseStructure> structures_of(const BegunCase& begun, const Grid& grid, std::ostream& messages,
                                         const std::function<void()>& go_on) {
    std::vector<CaseStructure> structures;
    for (std::size_t i = 0; i < begun.segmentations.size(); ++i) {
        const Segmentation& segmentation = *begun.segmentations[i];
        // If labels stand in for a scan, the import prints the first file's notes as the scan's.
        if (i > 0 || begun.labels == 0)
            for (const std::string& note : segmentation.image.notes) messages << printable(note) << '\n';
        if (segmentation.segments.empty())
            messages << fmt::format("{}: no voxel has a label; left out\n", segmentation.path.string());
        for (const Segment& segment : segmentation.segments) {
            go_on();
            StructureMask mask = structure_of(segmentation, segment, grid);
            if (mask.empty()) {
                messages << fmt::format("{}: segment \"{}\" lies outside the bone; left out\n",
                                        segmentation.path.string(), segment.name);
                continue;
            }
            structures.push_back({.structure = {.name = segment.name,
                                                .colour_rgb = segment.colour_rgb.value_or(
                                                    palette[structures.size() % palette.size()]),
                                                .mask = std::move(mask)},
                                  .material = material_of(segment.name, begun.parts, i < begun.labels)});
        }
    }
    if (structures.size() > most_tissues)
        throw std::runtime_error(
            fmt::format("the segmentations have more than {} segments in the bone's box", most_tissues));
    if (structures.empty())
        throw std::runtime_error(fmt::format("{}: none of its segments lies in the bone's box",
                                             begun.segmentations.front()->path.string()));
    return structures;
}

std::vector<Tissue> tissues_of(const std::vector<CaseStructure>& structures, const CaseParts& parts) {
    std::vector<Tissue> tissues;
    for (const auto& [one, material] : structures) {
        Tissue tissue{.label = static_cast<std::uint8_t>(tissues.size() + 1),
                      .name = one.name,
                      .colour_rgb = one.colour_rgb,
                      .segment = one.name};
        if (std::ranges::find(parts.is_protected, one.name) != parts.is_protected.end()) {
            tissue.is_protected = true;
            tissue.shows_through_mm = usual_shows_through_mm(true);
            const auto own = parts.warns_from_mm.find(one.name);
            tissue.warn_mm = own != parts.warns_from_mm.end() ? own->second : parts.warn_mm;
        }
        if (material != nullptr)
            tissue.strength = TissueStrength{.material = material->name,
                                             .relative_stiffness = material->relative_stiffness,
                                             .relative_edge = material->relative_edge};
        tissues.push_back(tissue);
    }
    std::set<std::string> names;
    for (const Tissue& tissue : tissues) names.insert(tissue.name);
    for (const std::string& name : parts.is_protected)
        if (!names.contains(name))
            throw std::runtime_error(fmt::format(
                "--protect: no voxel of the bone's box is in \"{}\": it would guard nothing", name));
    return tissues;
}

}  // namespace

std::string scene_of_case(const std::string& name) {
    const std::vector<std::string> built_in(phantom_names.begin(), phantom_names.end());
    for (const std::string& one : built_in)
        if (one == name) return name;
    const std::filesystem::path scene = std::filesystem::path(name) / scene_name;
    std::error_code failed;
    if (std::filesystem::is_regular_file(scene, failed)) {
        if (!lies_inside(scene, name))
            throw std::invalid_argument(
                fmt::format("--case: {} is a link that leads out of its folder", scene.string()));
        return scene.string();
    }
    const std::optional<std::string> nearest = nearest_name(name, built_in);
    throw std::invalid_argument(fmt::format("--case: '{}' is no folder with a {}; built in are {}{}", name,
                                            scene_name, fmt::join(built_in, ", "),
                                            nearest ? fmt::format("; did you mean {}?", *nearest) : ""));
}

std::string name_of_case(const std::filesystem::path& folder) {
    const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
    const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    require_plain("--case: the folder's name", name);
    return name;
}

BegunCase read_case_parts(CaseParts parts) {
    BegunCase begun;
    for (const auto& path : label_maps(parts.labels)) begun.segmentations.push_back(read(path, parts));
    begun.labels = begun.segmentations.size();
    for (const auto& path : label_maps(parts.segmentations)) begun.segmentations.push_back(read(path, parts));
    const std::set<std::string> names = segment_names(begun);
    for (std::string& name : parts.is_protected) name = known_name("--protect", name, names);
    for (const auto& [name, mm] : std::exchange(parts.warns_from_mm, {}))
        parts.warns_from_mm[known_name("--protect", name, names)] = mm;
    if (parts.target) parts.target = known_name("--target", *parts.target, names);
    for (const auto& [name, material] : std::exchange(parts.materials, {})) {
        (void)material_named(material);
        parts.materials[known_name("--material", name, names)] = material;
    }
    begun.parts = std::move(parts);
    return begun;
}

void begin_case(const std::filesystem::path& folder) {
    name_of_case(folder);
    std::error_code failed;
    if (std::filesystem::exists(folder / scene_name, failed))
        throw std::runtime_error(fmt::format(
            "{}: holds a case already; give another --case, or take it away first", folder.string()));
    for (const auto& file : files_of_case(folder))
        if (std::filesystem::is_symlink(file, failed))
            throw std::runtime_error(fmt::format(
                "{}: is a link, which a new case would write through; take it away", file.string()));
    std::filesystem::create_directories(folder, failed);
    if (!std::filesystem::is_directory(folder))
        throw std::runtime_error(fmt::format("{}: cannot be made a folder", folder.string()));
}

UnfinishedCase::UnfinishedCase(const std::filesystem::path& folder) {
    made_ = files_of_case(folder);
    made_.push_back(folder);
    std::error_code failed;
    std::erase_if(made_, [&](const auto& path) {
        return std::filesystem::exists(std::filesystem::symlink_status(path, failed));
    });
}

UnfinishedCase::~UnfinishedCase() {
    std::error_code ignored;  // a folder that holds something else stays
    for (const auto& path : made_) std::filesystem::remove(path, ignored);
}

OpenedImage scan_of_labels(const BegunCase& begun, std::ostream& messages, bool is_to_look_at) {
    const std::vector<std::shared_ptr<const Segmentation>> maps(
        begun.segmentations.begin(), begun.segmentations.begin() + static_cast<std::ptrdiff_t>(begun.labels));
    bool is_any_bone = false;
    for (const auto& map : maps)
        for (const Segment& segment : map->segments) {
            const Material* material = material_of(segment.name, begun.parts, true);
            is_any_bone = is_any_bone || material != nullptr;
            messages << fmt::format("\"{}\" is {}\n", segment.name,
                                    material != nullptr ? "made of " + material->name : "no bone");
        }
    return bone_of_labels(maps, [&](const Segment& segment) {
        return (is_to_look_at && !is_any_bone) || material_of(segment.name, begun.parts, true) != nullptr;
    });
}

std::vector<std::filesystem::path> files_of_case(const std::filesystem::path& folder) {
    return {folder / scene_name, bone_of_case(folder), folder / segmentation_name, folder / picture_name};
}

std::filesystem::path bone_of_case(const std::filesystem::path& folder) {
    return folder / "bone.nrrd";
}

void finish_case(const std::filesystem::path& folder, const BegunCase& begun, std::ostream& messages,
                 const std::function<void()>& go_on) {
    Scene scene = scene_of_bone_file(bone_of_case(folder));
    scene.name = name_of_case(folder);
    std::filesystem::path segmentation;
    if (!begun.segmentations.empty()) {
        auto structures = structures_of(begun, BoneFile(bone_of_case(folder)).grid(), messages, go_on);
        scene.tissues = tissues_of(structures, begun.parts);
        std::vector<NamedStructure> named;
        for (CaseStructure& one : structures) named.push_back(std::move(one.structure));
        write_segmentation(folder / segmentation_name, named);
        segmentation = segmentation_name;
        if (begun.parts.target) scene.plan = Plan{.region = TissueRegion{*begun.parts.target}};
    }
    // Loaded as a session will load it: an error then is an error now.
    Scene loaded = scene;
    loaded.bone = FileSource{.path = bone_of_case(folder),
                             .threshold_hu = {},
                             .segmentation = segmentation.empty() ? segmentation : folder / segmentation};
    const Bone bone = load_bone(loaded).bone;
    place_on_bone(scene, bone);
    go_on();
    scene.description =
        begun.parts.description.empty() ? sentence_about(scene, bone) : begun.parts.description;
    scene.pass = begun.parts.pass;
    write_card_picture(scene, bone, folder / picture_name);
    scene.bone =
        FileSource{.path = bone_of_case("").filename(), .threshold_hu = {}, .segmentation = segmentation};
    write_atomic_file(folder / scene_name, with_digest(preface + write_scene(scene)), Link::replace);
}

}  // namespace osteomill
