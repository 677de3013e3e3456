#include "common/scene/task_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "common/scene/nearest_name.h"
#include "common/scene/rating_condition.h"
#include "common/scene/rating_quantities.h"
#include "common/scene/scene_keys.h"
#include "common/text/foreign_text.h"

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

namespace {

/// Names that a quantity may have, and the word for them.
struct Names {
    const char* what;
    std::vector<std::string> all{};
};

Names names_for(RatedThing of, const Scene& scene) {
    Names names{of == RatedThing::burr                                            ? "burr"
                : of == RatedThing::tissue || of == RatedThing::session_or_tissue ? "tissue"
                                                                                  : "protected tissue"};
    if (of == RatedThing::burr)
        for (const Burr& burr : scene.burrs) names.all.push_back(burr.name);
    else
        for (const Tissue& tissue : scene.tissues)
            if (tissue.is_protected || of == RatedThing::tissue || of == RatedThing::session_or_tissue)
                names.all.push_back(tissue.name);
    return names;
}

/// Nothing: the scene can answer it.
std::optional<std::string> why_not_answered(const AskedQuantity& asked, const Scene& scene, bool has_region) {
    const RatedThing of = rated_quantity(asked.key)->of;
    const bool takes_none = of == RatedThing::session || of == RatedThing::plan || of == RatedThing::region;
    if (of == RatedThing::plan && !scene.plan)
        return fmt::format("asks for '{}', and the scene has no [plan]", asked.key);
    if (of == RatedThing::region && !has_region)
        return fmt::format(
            "asks for '{}', and the item has no region: give it a tissue, a sphere or a cylinder", asked.key);
    if (takes_none)
        return asked.of.empty() ? std::nullopt
                                : std::optional(fmt::format("asks for '{}' of '{}'; it takes no name",
                                                            asked.key, asked.of));
    const Names names = names_for(of, scene);
    if (names.all.empty())
        return fmt::format("asks for '{}', and the scene has no {}", asked.key, names.what);
    if (asked.of.empty())
        return of == RatedThing::any_structure || of == RatedThing::session_or_tissue ||
                       of == RatedThing::burr
                   ? std::nullopt
                   : std::optional(fmt::format("asks for '{0}' without saying of which {1}; write {0}('{2}')",
                                               asked.key, names.what, names.all.front()));
    if (std::ranges::find(names.all, asked.of) != names.all.end()) return std::nullopt;
    auto meant = same_name(asked.of, names.all);
    if (!meant) meant = nearest_name(asked.of, names.all);
    return fmt::format("asks for '{}' of '{}', which is no {} of the scene{}", asked.key, one_line(asked.of),
                       names.what, meant ? "; did you mean '" + *meant + "'?" : "");
}

std::string bounded(TomlReader& reader, const char* key, std::size_t most) {
    std::string text = reader.text(key).value_or("");
    if (text.size() > most)
        reader.fail(key, fmt::format("'{}' in [[rating]] has {} letters; at most {} are read", key,
                                     text.size(), most));
    return text;
}

RatingItem read_item(TomlReader& reader, const Scene& scene) {
    RatingItem item{.name = bounded(reader, "name", longest_rating_name)};
    if (item.name.empty()) reader.fail_missing("name");
    scene_keys::of_rating_item(reader, item, RatingItem());
    item.when = bounded(reader, "when", longest_rating_condition);
    item.source = bounded(reader, "source", longest_rating_source);
    item.region = read_region(reader, scene.tissues, "[[rating]]");
    reader.refuse_other_keys();
    if (item.when.empty()) reader.fail_missing("when");
    const auto refuse = [&](const std::string& why) {
        reader.fail("when", fmt::format("[[rating]] \"{}\": 'when' {}", one_line(item.name), why));
    };
    try {
        const RatingCondition condition(item.when);
        for (const AskedQuantity& asked : condition.quantities())
            if (const auto why = why_not_answered(asked, scene, item.region.has_value())) refuse(*why);
    } catch (const ConditionError& error) {
        refuse(error.what());
    }
    return item;
}

}  // namespace

Rating read_rating(std::vector<TomlReader> readers, const Scene& scene) {
    if (readers.size() > most_rating_items)
        readers[most_rating_items].fail("name", fmt::format("{} items of [[rating]]; at most {} are read",
                                                            readers.size(), most_rating_items));
    Rating rating;
    for (TomlReader& reader : readers) {
        RatingItem item = read_item(reader, scene);
        if (std::ranges::find(rating, item.name, &RatingItem::name) != rating.end())
            reader.fail("name",
                        fmt::format("two items of [[rating]] are called \"{}\"", one_line(item.name)));
        rating.push_back(std::move(item));
    }
    return rating;
}

namespace {

const std::vector<std::string> kind_names(fixture_kind_names.begin(), fixture_kind_names.end());

LineGuide read_line(TomlReader reader) {
    const LineGuide line{.from_mm = required(reader, "from_mm", reader.place("from_mm")),
                         .to_mm = required(reader, "to_mm", reader.place("to_mm"))};
    reader.refuse_other_keys();
    if (glm::length(line.to_mm - line.from_mm) < 0.01)
        reader.fail("to_mm", "a line is at least 0.01 mm long: 'from_mm' and 'to_mm' are one place");
    return line;
}

PlaneGuide read_plane(TomlReader reader) {
    const PlaneGuide plane{.at_mm = required(reader, "at_mm", reader.place("at_mm")),
                           .normal = required(reader, "normal", reader.direction("normal"))};
    reader.refuse_other_keys();
    return plane;
}

void read_path(TomlReader& reader, Fixture& fixture) {
    const std::optional<TomlReader> line = reader.table("line");
    const std::optional<TomlReader> plane = reader.table("plane");
    if (line.has_value() == plane.has_value())
        reader.fail("line",
                    "a guide takes either line = { from_mm = [x, y, z], to_mm = [x, y, z] }, or plane = { "
                    "at_mm = [x, y, z], normal = [x, y, z] }");
    if (line)
        fixture.path = read_line(*line);
    else
        fixture.path = read_plane(*plane);
}

std::string read_tissue(TomlReader& reader, std::span<const Tissue> tissues) {
    std::string name = required(reader, "tissue", reader.text("tissue"));
    std::string choices;
    for (const Tissue& tissue : tissues) {
        if (!tissue.is_protected) continue;
        if (tissue.name == name) return name;
        choices += fmt::format("{}\"{}\"", choices.empty() ? "" : ", ", tissue.name);
    }
    reader.fail("tissue",
                fmt::format("'tissue' = \"{}\" is no protected tissue of the scene; {}", one_line(name),
                            choices.empty() ? "it has none: give one of [[tissues]] protected = true"
                                            : "take one of " + choices));
}

Fixture read_fixture(TomlReader& reader, std::span<const Tissue> tissues) {
    std::string name = required(reader, "name", reader.text("name"));
    if (name.empty() || name.size() > longest_fixture_name)
        reader.fail("name", fmt::format("'name' must have 1 to {} letters", longest_fixture_name));
    Fixture fixture =
        usual_fixture(static_cast<FixtureKind>(required(reader, "kind", reader.choice("kind", kind_names))));
    fixture.name = std::move(name);
    if (fixture.kind == FixtureKind::guide)
        read_path(reader, fixture);
    else
        fixture.tissue = read_tissue(reader, tissues);
    scene_keys::of_fixture(reader, fixture, usual_fixture(fixture.kind));
    reader.refuse_other_keys();
    if (fixture.kind == FixtureKind::guide && fixture.reach_mm <= fixture.fade_mm)
        reader.fail("reach_mm",
                    fmt::format("a guide's 'reach_mm' must be above its 'fade_mm' = {}", fixture.fade_mm));
    return fixture;
}

}  // namespace

std::vector<Fixture> read_fixtures(std::vector<TomlReader> readers, std::span<const Tissue> tissues) {
    std::vector<Fixture> fixtures;
    std::set<std::string> names;
    for (TomlReader& reader : readers) {
        fixtures.push_back(read_fixture(reader, tissues));
        if (fixtures.size() > most_fixtures)
            reader.fail("name", fmt::format("a scene has at most {} of [[fixture]]", most_fixtures));
        if (!names.insert(fixtures.back().name).second)
            reader.fail("name",
                        fmt::format("two fixtures are called \"{}\"", one_line(fixtures.back().name)));
    }
    return fixtures;
}

}  // namespace osteomill
