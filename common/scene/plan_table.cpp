#include "common/scene/plan_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/scene/scene_keys.h"

namespace osteomill {

namespace {

constexpr double most_mm = 500.0;
constexpr const char* region_keys =
    "tissue = \"NAME\", sphere = { centre_mm = [x, y, z], radius_mm = r } and cylinder = { from_mm = [x, y, "
    "z], "
    "to_mm = [x, y, z], radius_mm = r }";

TissueRegion read_tissue(TomlReader& reader, const std::string& name, std::span<const Tissue> tissues) {
    std::string names;
    for (const Tissue& tissue : tissues) {
        if (tissue.name == name) return {name};
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", tissue.name);
    }
    reader.fail("tissue", fmt::format("'tissue' = \"{}\" is no tissue of the scene; {}", name,
                                      names.empty() ? "it has none: add it as one of [[tissues]]"
                                                    : "take one of " + names));
}

SphereRegion read_sphere(TomlReader reader) {
    SphereRegion sphere{.centre_mm = required(reader, "centre_mm", reader.place("centre_mm"))};
    sphere.radius_mm = required(reader, "radius_mm", reader.number("radius_mm", {0.01, most_mm}));
    reader.refuse_other_keys();
    return sphere;
}

CylinderRegion read_cylinder(TomlReader reader) {
    CylinderRegion cylinder{.from_mm = required(reader, "from_mm", reader.place("from_mm")),
                            .to_mm = required(reader, "to_mm", reader.place("to_mm"))};
    cylinder.radius_mm = required(reader, "radius_mm", reader.number("radius_mm", {0.01, most_mm}));
    reader.refuse_other_keys();
    if (glm::length(cylinder.to_mm - cylinder.from_mm) < 0.01)
        reader.fail("to_mm", "a cylinder is at least 0.01 mm long: 'from_mm' and 'to_mm' are one place");
    return cylinder;
}

}  // namespace

std::optional<PlanRegion> read_region(TomlReader& reader, std::span<const Tissue> tissues,
                                      const char* table) {
    const std::optional<std::string> tissue = reader.text("tissue");
    const std::optional<TomlReader> sphere = reader.table("sphere");
    const std::optional<TomlReader> cylinder = reader.table("cylinder");
    if (int{tissue.has_value()} + int{sphere.has_value()} + int{cylinder.has_value()} > 1)
        reader.fail("tissue", std::string(table) + " takes one of " + region_keys);
    if (tissue) return read_tissue(reader, *tissue, tissues);
    if (sphere) return read_sphere(*sphere);
    if (cylinder) return read_cylinder(*cylinder);
    return std::nullopt;
}

Plan read_plan(TomlReader reader, std::span<const Tissue> tissues) {
    Plan plan;
    std::optional<PlanRegion> region = read_region(reader, tissues, "[plan]");
    scene_keys::of_plan(reader, plan, Plan());
    reader.refuse_other_keys();
    if (!region) reader.fail("tissue", std::string("[plan] takes one of ") + region_keys);
    plan.region = *std::move(region);
    return plan;
}

PassMarks read_pass_marks(TomlReader reader, const Scene& scene) {
    PassMarks marks;
    for (const PassMarkKind& kind : pass_mark_kinds)
        if (const auto mark = reader.number(kind.metric, {kind.low, kind.high})) marks[kind.metric] = *mark;
    reader.refuse_other_keys();
    for (const auto& [metric, mark] : marks) {
        if (metric.starts_with("plan_") && !scene.plan)
            reader.fail(metric, fmt::format("'{}' needs a [plan] to measure against", metric));
        if (metric == "rating_share" && scene.rating.empty())
            reader.fail(metric, fmt::format("'{}' needs items of [[rating]]", metric));
        if (metric == "structure_touches" && std::ranges::none_of(scene.tissues, &Tissue::is_protected))
            reader.fail(metric, fmt::format("'{}' needs a tissue with protected = true", metric));
    }
    return marks;
}

}  // namespace osteomill
