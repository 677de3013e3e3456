#include "common/scene/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "common/files/needed_version.h"
#include "common/scene/scene.h"
#include "common/scene/scene_keys.h"
#include "common/scene/task_tables.h"
#include "common/scene/tissue_tables.h"
#include "common/scene/toml_reader.h"
#include "common/scene/toml_text.h"
#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

const std::vector<std::string> motion_names(trajectory_names.begin(), trajectory_names.end());
const std::vector<std::string> phantom_choices(phantom_names.begin(), phantom_names.end());

std::filesystem::path resolved(const std::string& path, const std::filesystem::path& folder) {
    const std::filesystem::path given(path);
    return given.is_absolute() || folder.empty() ? given : folder / given;
}

std::variant<PhantomSource, FileSource> read_bone(TomlReader reader, const std::filesystem::path& folder) {
    const std::optional<std::size_t> phantom = reader.choice("phantom", phantom_choices);
    const std::optional<std::string> file = reader.text("file");
    const std::optional<double> threshold_hu = reader.number("threshold_hu", {-1024.0, 10'000.0});
    const std::optional<std::string> segmentation = reader.text("segmentation");
    reader.refuse_other_keys();
    if (phantom.has_value() == file.has_value())
        reader.fail("phantom", fmt::format("[bone] takes either phantom = \"{}\", or file = \"bone.nrrd\"",
                                           fmt::join(phantom_choices, "\", \"")));
    if (phantom && threshold_hu)
        reader.fail("threshold_hu", "'threshold_hu' goes with file, not with phantom");
    if (phantom && segmentation)
        reader.fail("segmentation", "'segmentation' goes with file, not with phantom");
    if (phantom) return PhantomSource{phantom_choices[*phantom]};
    if (segmentation && segmentation->empty())
        reader.fail("segmentation", "'segmentation' must name a file, such as \"segmentation.seg.nrrd\"");
    return FileSource{resolved(*file, folder), threshold_hu,
                      segmentation ? resolved(*segmentation, folder) : std::filesystem::path()};
}

StiffnessRelation read_stiffness(TomlReader reader) {
    StiffnessRelation relation;
    for (const auto& row : required(reader, "knots", reader.rows("knots", 2)))
        relation.knots.push_back({row[0], row[1]});
    reader.refuse_other_keys();
    try {
        require_valid(relation);
    } catch (const std::invalid_argument& error) {
        reader.fail("knots", error.what());
    }
    return relation;
}

ShankProfile read_shank(TomlReader& reader, double burr_radius_mm) {
    ShankProfile shank;
    const auto rows = reader.rows("shank", 2);
    if (!rows) return shank;
    if (rows->empty()) reader.fail("shank", "a shank takes 2 to 8 points; for none leave 'shank' out");
    for (const auto& row : *rows) shank.push_back({row[0], row[1]});
    try {
        require_valid(shank, burr_radius_mm);
    } catch (const std::invalid_argument& error) {
        reader.fail("shank", error.what());
    }
    return shank;
}

BurrHead read_head(TomlReader& reader, double diameter_mm) {
    const std::vector<std::string> names(head_shape_names.begin(), head_shape_names.end());
    const auto shape = static_cast<HeadShape>(reader.choice("shape", names).value_or(0));
    const std::optional<double> length_mm = reader.number("length_mm", {0.1, 30.0});
    const std::optional<double> tip_mm = reader.number("tip_diameter_mm", {0.05, 20.0});
    const std::optional<double> neck_mm = reader.number("neck_diameter_mm", {0.05, 20.0});
    if (shape == HeadShape::ball) {
        if (length_mm || tip_mm || neck_mm)
            reader.fail("shape", "a ball takes 'diameter_mm' alone; for another head set 'shape'");
        return {};
    }
    BurrHead head = usual_head(shape, diameter_mm, required(reader, "length_mm", length_mm));
    head.tip_diameter_mm = tip_mm.value_or(head.tip_diameter_mm);
    head.neck_diameter_mm = neck_mm.value_or(head.neck_diameter_mm);
    try {
        require_valid(head, diameter_mm);
    } catch (const std::invalid_argument& error) {
        reader.fail("shape", error.what());
    }
    return head;
}

Burr read_burr(TomlReader& reader) {
    Burr burr;
    burr.name = required(reader, "name", reader.text("name"));
    burr.diameter_mm = required(reader, "diameter_mm", reader.number("diameter_mm", {0.2, 20.0}));
    burr.head = read_head(reader, burr.diameter_mm);
    scene_keys::of_burr(reader, burr, Burr());
    const glm::dvec3& k = burr.cutting_coefficients_n_per_mm2;
    if (!(k.x > 0.0 && k.y >= 0.0 && k.z >= 0.0 && k.x < 1e5 && k.y < 1e5 && k.z < 1e5))
        reader.fail("cutting_coefficients_n_per_mm2",
                    "K_t must be above 0, K_r and K_a at least 0, all below 100000 N/mm^2");
    const glm::dvec3& e = burr.edge_coefficients_n_per_mm;
    if (!(e.x >= 0.0 && e.y >= 0.0 && e.z >= 0.0 && e.x <= 100.0 && e.y <= 100.0 && e.z <= 100.0))
        reader.fail("edge_coefficients_n_per_mm",
                    "K_te, K_re and K_ae must be at least 0 and at most 100 N/mm");
    burr.shank = read_shank(reader, burr.radius_mm());
    reader.refuse_other_keys();
    return burr;
}

Motor read_motor(TomlReader reader) {
    Motor motor;
    scene_keys::of_motor(reader, motor);
    reader.refuse_other_keys();
    if (motor.steady_torque_n_mm >= motor.stall_torque_n_mm)
        reader.fail("steady_torque_n_mm", "'steady_torque_n_mm' must be below 'stall_torque_n_mm'");
    return motor;
}

/// A matrix of seven digits is a rotation only to seven digits, and a pose mapped there and back would
/// differ. Two steps of Newton's method make it a rotation to the last bit; an exact rotation stays as it is.
glm::dmat3 orthonormal(const glm::dmat3& rotation, double defect) {
    if (defect < 1e-14) return rotation;
    glm::dmat3 better = rotation;
    for (int step = 0; step < 2; ++step)
        better = 0.5 * better * (glm::dmat3(3.0) - glm::transpose(better) * better);
    return better;
}

DeviceMapping read_device(TomlReader reader) {
    DeviceMapping mapping;
    if (const auto rows = reader.rows("rotation", 3)) {
        if (rows->size() != 3) reader.fail("rotation", "'rotation' must have three rows");
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                mapping.rotation[column][row] =
                    (*rows)[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        const glm::dmat3 product = glm::transpose(mapping.rotation) * mapping.rotation;
        double defect = std::abs(glm::determinant(mapping.rotation) - 1.0);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                defect = std::max(defect, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
        if (defect > 1e-6)
            reader.fail("rotation",
                        "'rotation' must be orthonormal with determinant +1 (rows of a rotation matrix)");
        mapping.rotation = orthonormal(mapping.rotation, defect);
    }
    scene_keys::of_device(reader, mapping, DeviceMapping());
    reader.refuse_other_keys();
    return mapping;
}

ToolPose read_pose(TomlReader reader) {
    ToolPose pose;
    scene_keys::of_start_pose(reader, pose, ToolPose());
    reader.refuse_other_keys();
    return pose;
}

TrajectorySpec read_trajectory(TomlReader reader, const std::filesystem::path& folder, const Burr& burr) {
    TrajectorySpec spec;
    const std::optional<std::size_t> motion = reader.choice("motion", motion_names);
    const std::optional<std::string> file = reader.text("file");
    scene_keys::of_trajectory(reader, spec, TrajectorySpec());
    reader.refuse_other_keys();
    if (motion.has_value() == file.has_value())
        reader.fail("motion",
                    "[trajectory] takes either motion = \"hold\", \"polishing\" or \"cavity\", or file = "
                    "\"path.csv\"");
    if (motion)
        spec.source = static_cast<BuiltInTrajectory>(*motion);
    else
        spec.source = resolved(*file, folder);
    if (spec.source == decltype(spec.source)(BuiltInTrajectory::cavity) && spec.width_mm < burr.diameter_mm)
        reader.fail("width_mm",
                    fmt::format("a hole of 'width_mm' = {} is too narrow for the start burr \"{}\" of {} mm",
                                spec.width_mm, burr.name, burr.diameter_mm));
    return spec;
}

Scene read_all(TomlReader reader, const std::filesystem::path& folder) {
    if (const auto needed = reader.text(needed_version_key))
        if (const auto why_not = why_not_for_this_version(*needed)) reader.fail(needed_version_key, *why_not);
    Scene scene;
    scene.name = required(reader, "name", reader.text("name"));
    scene.description = reader.text("description").value_or("");
    scene.bone = read_bone(required(reader, "bone", reader.table("bone")), folder);
    if (auto table = reader.table("stiffness")) scene.stiffness = read_stiffness(*table);
    const auto* file = std::get_if<FileSource>(&scene.bone);
    scene.tissues = read_tissues(reader.tables("tissues"), file != nullptr && !file->segmentation.empty());
    for (TomlReader& burr : reader.tables("burrs")) scene.burrs.push_back(read_burr(burr));
    if (scene.burrs.empty()) scene.burrs = default_burr_set(Burr().spindle_rev_per_s);
    std::vector<std::string> burr_names;
    for (const Burr& burr : scene.burrs) {
        if (std::find(burr_names.begin(), burr_names.end(), burr.name) != burr_names.end())
            reader.fail("burrs", fmt::format("two burrs are called \"{}\"", burr.name));
        burr_names.push_back(burr.name);
    }
    scene.start_burr = reader.choice("start_burr", burr_names).value_or(0);
    scene_keys::of_scene(reader, scene, Scene());
    if (auto table = reader.table("motor")) scene.motor = read_motor(*table);
    if (auto table = reader.table("coupling")) {
        scene_keys::of_coupling(*table, scene, Scene());
        table->refuse_other_keys();
    }
    if (auto table = reader.table("device")) scene.device = read_device(*table);
    if (auto table = reader.table("start_pose")) scene.start_pose = read_pose(*table);
    if (auto table = reader.table("trajectory"))
        scene.trajectory = read_trajectory(*table, folder, scene.burrs[scene.start_burr]);
    if (auto table = reader.table("plan")) scene.plan = read_plan(*table, scene.tissues);
    scene.fixtures = read_fixtures(reader.tables("fixture"), scene.tissues);
    scene.rating = read_rating(reader.tables("rating"), scene);
    if (auto table = reader.table("pass")) scene.pass = read_pass_marks(*table, scene);
    reader.refuse_other_keys();
    return scene;
}

/// The file was read without an error before.
Scene read_changed(toml::table root, const SceneChanges& changes, const std::filesystem::path& folder) {
    constexpr const char* no_file = "changed";
    try {
        for (const SceneChange& change : changes.changes) apply(change, root);
        return read_all(TomlReader(root, no_file, "the scene"), folder);
    } catch (const SceneError& error) {
        // A changed value has no line.
        const std::string line = error.what();
        const bool has_place = line.starts_with(std::string(no_file) + ":");
        throw SceneError(changes.option + ": " + (has_place ? line.substr(line.find(": ") + 2) : line));
    }
}

}  // namespace

SceneError::SceneError(const std::string& message) : std::runtime_error(printable(message)) {}

Scene parse_scene(std::string_view text, const std::string& name_for_messages,
                  const std::filesystem::path& folder, const SceneChanges& changes) {
    const toml::table root = parse_toml(text, name_for_messages);
    Scene scene = read_all(TomlReader(root, name_for_messages, "the scene"), folder);
    return changes.changes.empty() ? scene : read_changed(root, changes, folder);
}

Scene read_scene(const std::filesystem::path& path, const SceneChanges& changes) {
    return parse_scene(read_toml_text(path, "a scene file"), path.string(), path.parent_path(), changes);
}

}  // namespace osteomill
