#include "imaging/case/case_placement.h"

#include <fmt/format.h>

#include "common/files/atomic_file.h"
#include "common/files/inside_folder.h"
#include "common/scene/scene_file.h"
#include "common/scene/toml_reader.h"
#include "common/scene/toml_text.h"
#include "imaging/case/case_trust.h"

namespace osteomill {

namespace {

std::filesystem::path file_of(const std::filesystem::path& folder) {
    return folder / "placement.toml";
}

}  // namespace

std::optional<ToolPose> placement_of_case(const std::filesystem::path& folder) {
    const std::filesystem::path path = file_of(folder);
    std::error_code failed;
    if (!std::filesystem::exists(path, failed)) return std::nullopt;
    if (!lies_inside(path, folder))
        throw SceneError(path.string() + ": is a link that leads out of the case's folder");
    const toml::table table = parse_toml(read_toml_text(path, "a placement"), path.string());
    TomlReader reader(table, path.string(), "the placement");
    const auto position_mm = reader.place("position_mm");
    const auto spindle_axis = reader.direction("spindle_axis");
    reader.refuse_other_keys();
    if (!position_mm) reader.fail_missing("position_mm");
    if (!spindle_axis) reader.fail_missing("spindle_axis");
    return ToolPose{*position_mm, *spindle_axis};
}

void remember_placement(const std::filesystem::path& folder, const ToolPose& pose) {
    const glm::dvec3& p = pose.position_mm;
    const glm::dvec3& a = pose.spindle_axis;
    write_atomic_file(
        file_of(folder),
        with_digest(fmt::format(
            "# Where the tool was put last, patient LPS. Without this file: [start_pose] of case.toml.\n"
            "position_mm = [ {:.3f}, {:.3f}, {:.3f} ]\nspindle_axis = [ {:.6f}, {:.6f}, {:.6f} ]\n",
            p.x, p.y, p.z, a.x, a.y, a.z)),
        Link::replace);
}

}  // namespace osteomill
