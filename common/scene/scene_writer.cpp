#include <fmt/format.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "common/scene/material.h"
#include "common/scene/scene_file.h"
#include "common/scene/scene_keys.h"
#include "common/scene/toml_text.h"

namespace osteomill {

namespace {

/// Reads back as the same number, bit for bit.
std::string as_toml(double number) {
    return fmt::format("{}", number);
}

std::string as_toml(int number) {
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
    // The keys of scene_keys.h.
    void number(const char* key, double value, double usual, const AllowedRange& /*range*/) {
        add(key, value, usual);
    }
    void needed_number(const char* key, double value, const AllowedRange& /*range*/) { add(key, value); }
    void whole_number(const char* key, int value, int usual, int /*low*/, int /*high*/) {
        add(key, value, usual);
    }
    void rpm(const char* key, double rev_per_s, double usual_rev_per_s, const AllowedRange& /*range*/) {
        add(key, rpm_of(rev_per_s), rpm_of(usual_rev_per_s));
    }
    void truth(const char* key, bool value, bool usual) { add(key, value, usual); }
    void vector(const char* key, const glm::dvec3& value, const glm::dvec3& usual) { add(key, value, usual); }
    void place(const char* key, const glm::dvec3& value, const glm::dvec3& usual) { add(key, value, usual); }
    void direction(const char* key, const glm::dvec3& value, const glm::dvec3& usual) {
        add(key, value, usual);
    }
    void text(const char* key, const std::string& value) { add_if_any(key, value); }
    template <typename Choice, typename Names>
    void choice(const char* key, Choice value, Choice usual, const Names& names) {
        add(key, std::string(names[static_cast<std::size_t>(value)]),
            std::string(names[static_cast<std::size_t>(usual)]));
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
    keys.add("label", int{tissue.label})
        .add("name", tissue.name)
        .add("colour", colour_text(tissue.colour_rgb))
        .add("identifier", colour_text(identifier_of(tissue)), colour_text(tissue.colour_rgb));
    scene_keys::of_tissue(keys, tissue, Tissue());
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
    scene_keys::of_tissue_under_burr(keys, tissue, Tissue());
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
    scene_keys::of_burr(keys, burr, Burr());
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
    scene_keys::of_device(keys, device, usual);
    return keys.below("\n# How the device lies on the patient.\n[device]\n");
}

std::string pose_text(const ToolPose& pose, SceneText extent) {
    Keys keys(extent);
    scene_keys::of_start_pose(keys, pose, ToolPose());
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
    scene_keys::of_trajectory(keys, trajectory, usual);
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
    scene_keys::of_plan(keys, plan, Plan());
    return keys.below("\n# The bone to remove.\n[plan]\n");
}

std::string rating_text(const Rating& rating, SceneText extent) {
    std::string text = rating.empty() ? "" : "\n# Items that earn a session points.\n";
    for (const RatingItem& item : rating) {
        Keys keys(extent);
        keys.add("name", item.name);
        scene_keys::of_rating_item(keys, item, RatingItem());
        keys.add("when", item.when);
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
    Keys keys(extent);
    keys.add("name", fixture.name).add("kind", fixture_kind_names[static_cast<std::size_t>(fixture.kind)]);
    if (fixture.kind == FixtureKind::guide)
        keys.add_text(path_text(fixture.path));
    else
        keys.add("tissue", fixture.tissue);
    scene_keys::of_fixture(keys, fixture, usual_fixture(fixture.kind));
    return "[[fixture]]\n" + keys.text();
}

}  // namespace

std::string write_scene(const Scene& scene, SceneText extent) {
    Keys top(extent);
    top.add("name", scene.name)
        .add_if_any("description", scene.description)
        .add("start_burr", scene.burrs.at(scene.start_burr).name, scene.burrs.at(0).name);
    scene_keys::of_scene(top, scene, Scene());
    std::string text = top.text();
    text += bone_text(scene.bone, extent) + stiffness_text(scene.stiffness, extent);
    if (!scene.tissues.empty()) text += "\n# Tissues, by their label in the bone.\n";
    for (const Tissue& tissue : scene.tissues) text += tissue_text(tissue, extent);
    if (scene.burrs != default_burr_set(Burr().spindle_rev_per_s) || extent == SceneText::complete) {
        text += "\n# Burrs to choose from.\n";
        for (const Burr& burr : scene.burrs) text += burr_text(burr, extent);
    }
    if (scene.motor) {
        Keys motor(extent);
        scene_keys::of_motor(motor, *scene.motor);
        text += motor.below("\n# How the spindle slows under load, as it is heard.\n[motor]\n");
    }
    Keys coupling(extent);
    scene_keys::of_coupling(coupling, scene, Scene());
    text += coupling.below("\n# How the bone's force comes to the hand.\n[coupling]\n");
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
