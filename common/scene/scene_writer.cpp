#include <fmt/format.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "common/scene/material.h"
#include "common/scene/scene_file.h"
#include "common/scene/tissue_tables.h"
#include "common/scene/toml_text.h"

namespace osteomill {

namespace {

/// Reads back as the same number, bit for bit.
std::string as_toml(double number) {
    return fmt::format("{}", number);
}

std::string as_toml(bool value) {
    return value ? "true" : "false";
}

std::string as_toml(std::string_view text) {
    return toml_quoted(text);
}

std::string as_toml(const std::string& text) {
    return as_toml(std::string_view(text));
}

std::string as_toml(const char* text) {
    return as_toml(std::string_view(text));
}

std::string as_toml(const std::filesystem::path& path) {
    return as_toml(path.generic_string());
}

std::string as_toml(const glm::dvec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

/// Keys of one table, each on a line.
class Keys {
  public:
    explicit Keys(SceneText extent) : is_complete_(extent == SceneText::complete) {}

    template <typename Value>
    Keys& add(const char* key, const Value& value) {
        text_ += fmt::format("{} = {}\n", key, as_toml(value));
        return *this;
    }
    /// Nothing if the value is that of an absent key, unless all is written.
    template <typename Value>
    Keys& add(const char* key, const Value& value, const Value& usual) {
        return value == usual && !is_complete_ ? *this : add(key, value);
    }
    /// Nothing if there is none.
    template <typename Value>
    Keys& add_if_any(const char* key, const Value& value) {
        return value.empty() ? *this : add(key, value);
    }
    Keys& add_text(const std::string& text) {
        text_ += text;
        return *this;
    }
    /// Empty if there are no keys.
    std::string below(const char* heading) const { return text_.empty() ? "" : heading + text_; }
    const std::string& text() const { return text_; }

  private:
    bool is_complete_;
    std::string text_;
};

/// The rpm that reads back as this speed, bit for bit, in as few digits as there are: rounding may put the
/// plain product one step beside it.
double rpm_of(double rev_per_s) {
    constexpr double seconds_per_minute = 60.0;
    const double product = rev_per_s * seconds_per_minute;
    for (const double rpm :
         {std::round(product), product, std::nextafter(product, 0.0), std::nextafter(product, HUGE_VAL)})
        if (rpm / seconds_per_minute == rev_per_s) return rpm;
    return product;
}

std::string bone_text(const std::variant<PhantomSource, FileSource>& bone, SceneText extent) {
    Keys keys(extent);
    if (const auto* phantom = std::get_if<PhantomSource>(&bone)) {
        keys.add("phantom", phantom->name);
    } else {
        const auto& file = std::get<FileSource>(bone);
        keys.add("file", file.path);
        if (file.threshold_hu) keys.add("threshold_hu", *file.threshold_hu);
        keys.add_if_any("segmentation", file.segmentation);
    }
    return keys.below("\n# The bone, and where its tissues are.\n[bone]\n");
}

std::string stiffness_text(const StiffnessRelation& relation, SceneText extent) {
    if (relation.knots == default_stiffness_relation().knots && extent == SceneText::concise) return {};
    std::string text =
        "\n# Relative stiffness by CT number: [HU, stiffness], 1 is cortical bone.\n[stiffness]\nknots = [\n";
    for (const StiffnessKnot& knot : relation.knots)
        text += fmt::format("    [{}, {}],\n", knot.hu, knot.relative_stiffness);
    return text + "]\n";
}

std::string colour_text(const std::array<std::uint8_t, 3>& rgb) {
    return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string tissue_text(const Tissue& tissue, SceneText extent) {
    Keys keys(extent);
    keys.add_text(fmt::format("label = {}\n", tissue.label))
        .add("name", tissue.name)
        .add("colour", colour_text(tissue.colour_rgb))
        .add("identifier", colour_text(identifier_of(tissue)), colour_text(tissue.colour_rgb))
        .add_if_any("segment", tissue.segment)
        .add("protected", tissue.is_protected, false)
        .add("warn_mm", tissue.warn_mm, usual_warn_mm(tissue.is_protected))
        .add("opacity", tissue.opacity, 1.0)
        .add("shows_through_mm", tissue.shows_through_mm, usual_shows_through_mm(tissue.is_protected))
        .add("shows_through_strength", tissue.shows_through_strength, Tissue().shows_through_strength);
    if (tissue.strength) {
        const TissueStrength& strength = *tissue.strength;
        const TissueStrength usual = usual_strength(strength);
        keys.add_if_any("material", strength.material);
        if (strength.material.empty())
            keys.add("relative_stiffness", strength.relative_stiffness);
        else
            keys.add("relative_stiffness", strength.relative_stiffness, usual.relative_stiffness);
        keys.add("relative_edge", strength.relative_edge, usual.relative_edge);
    }
    keys.add("stiffness_factor", tissue.stiffness_factor, 1.0).add("cuttable", tissue.is_cuttable, true);
    return "\n[[tissues]]\n" + keys.text();
}

std::string burr_text(const Burr& burr, SceneText extent) {
    Keys keys(extent);
    keys.add("name", burr.name).add("diameter_mm", burr.diameter_mm);
    if (!burr.is_ball()) {
        keys.add("shape", head_shape_names[static_cast<std::size_t>(burr.head.shape)])
            .add("length_mm", burr.head.length_mm);
        if (burr.head.shape != HeadShape::pear) keys.add("tip_diameter_mm", burr.head.tip_diameter_mm);
        keys.add("neck_diameter_mm", burr.head.neck_diameter_mm);
    }
    const Burr usual;
    if (burr.edges != usual.edges || extent == SceneText::complete)
        keys.add_text(fmt::format("edges = {}\n", burr.edges));
    keys.add("rpm", rpm_of(burr.spindle_rev_per_s), default_spindle_rpm)
        .add("cutting_coefficients_n_per_mm2", burr.cutting_coefficients_n_per_mm2,
             usual.cutting_coefficients_n_per_mm2)
        .add("edge_coefficients_n_per_mm", burr.edge_coefficients_n_per_mm, usual.edge_coefficients_n_per_mm);
    keys.add("turns", std::string(spindle_sense_names[burr.sense == SpindleSense::clockwise ? 0 : 1]),
             std::string(spindle_sense_names[0]));
    keys.add("run_out_mm", burr.run_out_mm, usual.run_out_mm);
    std::string shank;
    for (const ShankPoint& point : burr.shank)
        shank += fmt::format("{}[{}, {}]", shank.empty() ? "" : ", ", point.height_mm, point.radius_mm);
    if (!shank.empty()) keys.add_text(fmt::format("shank = [{}]\n", shank));
    return "\n[[burrs]]\n" + keys.text();
}

std::string device_text(const DeviceMapping& device, SceneText extent) {
    const DeviceMapping usual;
    Keys keys(extent);
    if (device.rotation != usual.rotation || extent == SceneText::complete) {
        const glm::dmat3 rows = glm::transpose(device.rotation);
        keys.add_text(
            fmt::format("rotation = [{}, {}, {}]\n", as_toml(rows[0]), as_toml(rows[1]), as_toml(rows[2])));
    }
    keys.add("scale", device.scale, usual.scale).add("offset_mm", device.offset_mm, usual.offset_mm);
    return keys.below("\n# How the device lies on the patient.\n[device]\n");
}

std::string pose_text(const ToolPose& pose, SceneText extent) {
    const ToolPose usual;
    Keys keys(extent);
    keys.add("position_mm", pose.position_mm, usual.position_mm)
        .add("spindle_axis", pose.spindle_axis, usual.spindle_axis);
    return keys.below(
        "\n# Where the tool starts: the burr's centre, and the direction from tip to shank.\n[start_pose]\n");
}

std::string trajectory_text(const TrajectorySpec& trajectory, SceneText extent) {
    const TrajectorySpec usual;
    if (trajectory == usual && extent == SceneText::concise) return {};
    Keys keys(extent);
    if (const auto* motion = std::get_if<BuiltInTrajectory>(&trajectory.source))
        keys.add("motion", trajectory_names[static_cast<std::size_t>(*motion)]);
    else
        keys.add("file", std::get<std::filesystem::path>(trajectory.source));
    keys.add("start_mm", trajectory.start_mm, usual.start_mm)
        .add("travel_direction", trajectory.travel_direction, usual.travel_direction)
        .add("speed_mm_per_s", trajectory.speed_mm_per_s, usual.speed_mm_per_s)
        .add("depth_mm", trajectory.depth_mm, usual.depth_mm)
        .add("width_mm", trajectory.width_mm, usual.width_mm);
    return keys.below("\n# The motion of a simulated hand.\n[trajectory]\n");
}

void add_region(Keys& keys, const PlanRegion& region) {
    if (const auto* tissue = std::get_if<TissueRegion>(&region)) keys.add("tissue", tissue->tissue);
    if (const auto* sphere = std::get_if<SphereRegion>(&region))
        keys.add_text(fmt::format("sphere = {{ centre_mm = {}, radius_mm = {} }}\n",
                                  as_toml(sphere->centre_mm), sphere->radius_mm));
    if (const auto* cylinder = std::get_if<CylinderRegion>(&region))
        keys.add_text(fmt::format("cylinder = {{ from_mm = {}, to_mm = {}, radius_mm = {} }}\n",
                                  as_toml(cylinder->from_mm), as_toml(cylinder->to_mm), cylinder->radius_mm));
}

std::string plan_text(const Plan& plan, SceneText extent) {
    Keys keys(extent);
    add_region(keys, plan.region);
    keys.add("margin_mm", plan.margin_mm, Plan().margin_mm);
    return keys.below("\n# The bone to remove.\n[plan]\n");
}

std::string rating_text(const Rating& rating, SceneText extent) {
    std::string text = rating.empty() ? "" : "\n# Items that earn a session points.\n";
    for (const RatingItem& item : rating) {
        Keys keys(extent);
        keys.add("name", item.name).add("points", item.points, RatingItem().points).add("when", item.when);
        keys.add_if_any("source", item.source);
        if (item.region) add_region(keys, *item.region);
        text += "[[rating]]\n" + keys.text();
    }
    return text;
}

std::string path_text(const std::variant<LineGuide, PlaneGuide>& path) {
    if (const auto* line = std::get_if<LineGuide>(&path))
        return fmt::format("line = {{ from_mm = {}, to_mm = {} }}\n", as_toml(line->from_mm),
                           as_toml(line->to_mm));
    const auto& plane = std::get<PlaneGuide>(path);
    return fmt::format("plane = {{ at_mm = {}, normal = {} }}\n", as_toml(plane.at_mm),
                       as_toml(plane.normal));
}

std::string fixture_text(const Fixture& fixture, SceneText extent) {
    const Fixture usual = usual_fixture(fixture.kind);
    Keys keys(extent);
    keys.add("name", fixture.name)
        .add("kind", fixture_kind_names[static_cast<std::size_t>(fixture.kind)])
        .add("on", fixture.is_on, true);
    if (fixture.kind == FixtureKind::guide)
        keys.add_text(path_text(fixture.path))
            .add("radius_mm", fixture.radius_mm, usual.radius_mm)
            .add("reach_mm", fixture.reach_mm, usual.reach_mm);
    else
        keys.add("tissue", fixture.tissue).add("distance_mm", fixture.distance_mm, usual.distance_mm);
    keys.add("fade_mm", fixture.fade_mm, usual.fade_mm)
        .add("damping_n_s_per_m", fixture.damping_n_s_per_m, usual.damping_n_s_per_m);
    if (fixture.kind == FixtureKind::slow)
        keys.add("spindle_share", fixture.spindle_share, usual.spindle_share);
    else
        keys.add("stiffness_n_per_mm", fixture.stiffness_n_per_mm, usual.stiffness_n_per_mm)
            .add("max_force_n", fixture.max_force_n, usual.max_force_n);
    return "[[fixture]]\n" + keys.text();
}

}  // namespace

std::string write_scene(const Scene& scene, SceneText extent) {
    std::string text = Keys(extent)
                           .add("name", scene.name)
                           .add_if_any("description", scene.description)
                           .add("start_burr", scene.burrs.at(scene.start_burr).name, scene.burrs.at(0).name)
                           .add("wall_friction", scene.wall_friction, Scene().wall_friction)
                           .add("force_scale", scene.force_scale, Scene().force_scale)
                           .text();
    text += bone_text(scene.bone, extent) + stiffness_text(scene.stiffness, extent);
    if (!scene.tissues.empty()) text += "\n# Tissues, by their label in the bone.\n";
    for (const Tissue& tissue : scene.tissues) text += tissue_text(tissue, extent);
    if (scene.burrs != default_burr_set(Burr().spindle_rev_per_s) || extent == SceneText::complete) {
        text += "\n# Burrs to choose from.\n";
        for (const Burr& burr : scene.burrs) text += burr_text(burr, extent);
    }
    if (scene.motor)
        text += Keys(extent)
                    .add("stall_torque_n_mm", scene.motor->stall_torque_n_mm)
                    .add("steady_torque_n_mm", scene.motor->steady_torque_n_mm, 0.0)
                    .below("\n# How the spindle slows under load, as it is heard.\n[motor]\n");
    text += Keys(extent)
                .add("feed_forward", scene.feed_forward, Scene().feed_forward)
                .below("\n# How the bone's force comes to the hand.\n[coupling]\n");
    text += device_text(scene.device, extent) + pose_text(scene.start_pose, extent) +
            trajectory_text(scene.trajectory, extent);
    if (scene.plan) text += plan_text(*scene.plan, extent);
    Keys pass(extent);
    for (const auto& [metric, mark] : scene.pass) pass.add(metric.c_str(), mark);
    text += pass.below("\n# The marks that a session has to reach.\n[pass]\n");
    text += rating_text(scene.rating, extent);
    if (!scene.fixtures.empty()) text += "\n# Fixtures that help the hand by force.\n";
    for (const Fixture& fixture : scene.fixtures) text += fixture_text(fixture, extent);
    return text;
}

}  // namespace osteomill
