#include "haptic_server/program/case_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <ostream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "common/files/whole_file.h"
#include "common/scene/nearest_name.h"
#include "common/scene/scene_file.h"
#include "haptic_server/imaging/phantom.h"
#include "haptic_server/imaging/segment_structure.h"
#include "haptic_server/program/bone_source.h"
#include "haptic_server/program/scene_on_bone.h"

namespace osteomill {

namespace {

constexpr const char* scene_name = "case.toml";
constexpr std::size_t most_tissues = 255;
/// For segments of which the file says no colour.
constexpr std::array<std::array<std::uint8_t, 3>, 6> palette{
    {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {213, 94, 0}, {204, 121, 167}}};
constexpr const char* preface =
    "# A case of Osteomill: a scene file (docs/scenes.md). Paths are relative to this folder.\n"
    "# Set protected = true for what must not be touched; warn_mm is then the distance from the burr at "
    "which\n"
    "# to warn, in mm. A tissue whose stiffness is to differ from what its CT numbers say takes\n"
    "# relative_stiffness or material.\n\n";

std::filesystem::path copied_segmentation(const std::filesystem::path& folder,
                                          const std::filesystem::path& segmentation) {
    const std::string name = segmentation.filename().string();
    for (const char* ending : {".seg.nrrd", ".nrrd", ".nii.gz", ".nii"}) {
        if (!name.ends_with(ending)) continue;
        const std::string copy = std::string("segmentation") + ending;
        WholeFile file(folder / copy);
        std::error_code failed;
        std::filesystem::copy_file(segmentation, file.part(),
                                   std::filesystem::copy_options::overwrite_existing, failed);
        if (failed)
            throw std::runtime_error(fmt::format("{}: cannot be copied into {}: {}", segmentation.string(),
                                                 folder.string(), failed.message()));
        file.commit();
        return copy;
    }
    throw std::runtime_error(
        fmt::format("{}: a case takes a segmentation in one file: .seg.nrrd, .nrrd, .nii or .nii.gz",
                    segmentation.string()));
}

std::vector<Tissue> tissues_of(const Segmentation& segmentation, const Grid& grid, std::ostream& messages) {
    std::vector<Tissue> tissues;
    for (const Segment& segment : segmentation.segments) {
        if (structure_of(segmentation, segment, grid).empty()) {
            messages << fmt::format("{}: segment \"{}\" lies outside the bone; left out\n",
                                    segmentation.path.string(), segment.name);
            continue;
        }
        if (tissues.size() == most_tissues)
            throw std::runtime_error(fmt::format("{}: has more than {} segments in the bone's box",
                                                 segmentation.path.string(), most_tissues));
        tissues.push_back(
            {.label = static_cast<std::uint8_t>(tissues.size() + 1),
             .name = segment.name,
             .colour_rgb = segment.colour_rgb.value_or(palette[tissues.size() % palette.size()]),
             .segment = segment.name});
    }
    if (tissues.empty())
        throw std::runtime_error(
            fmt::format("{}: none of its segments lies in the bone's box", segmentation.path.string()));
    return tissues;
}

}  // namespace

std::string scene_of_case(const std::string& name) {
    const std::vector<std::string> built_in = phantom_names();
    for (const std::string& one : built_in)
        if (one == name) return name;
    const std::filesystem::path scene = std::filesystem::path(name) / scene_name;
    std::error_code failed;
    if (std::filesystem::is_regular_file(scene, failed)) return scene.string();
    const std::optional<std::string> nearest = nearest_name(name, built_in);
    throw std::invalid_argument(fmt::format("--case: '{}' is no folder with a {}; built in are {}{}", name,
                                            scene_name, fmt::join(built_in, ", "),
                                            nearest ? fmt::format("; did you mean {}?", *nearest) : ""));
}

std::string name_of_case(const std::filesystem::path& folder) {
    const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

void begin_case(const std::filesystem::path& folder,
                const std::optional<std::filesystem::path>& segmentation) {
    std::error_code failed;
    if (std::filesystem::exists(folder / scene_name, failed))
        throw std::runtime_error(fmt::format(
            "{}: holds a case already; give another --case, or take it away first", folder.string()));
    if (segmentation) read_segmentation(*segmentation);  // refused before an hour of work
    std::filesystem::create_directories(folder, failed);
    if (!std::filesystem::is_directory(folder))
        throw std::runtime_error(fmt::format("{}: cannot be made a folder", folder.string()));
}

std::filesystem::path bone_of_case(const std::filesystem::path& folder) {
    return folder / "bone.nrrd";
}

void finish_case(const std::filesystem::path& folder,
                 const std::optional<std::filesystem::path>& segmentation, std::ostream& messages) {
    Scene scene = scene_of_bone_file(bone_of_case(folder));
    scene.name = name_of_case(folder);
    std::filesystem::path copy;
    if (segmentation) {
        const Grid grid = BoneFile(bone_of_case(folder)).grid();
        scene.tissues = tissues_of(read_segmentation(*segmentation), grid, messages);
        copy = copied_segmentation(folder, *segmentation);
    }
    place_on_bone(scene, load_bone(scene).bone);
    scene.bone = FileSource{.path = bone_of_case("").filename(), .threshold_hu = {}, .segmentation = copy};
    write_whole_file(folder / scene_name, preface + write_scene(scene));
}

}  // namespace osteomill
