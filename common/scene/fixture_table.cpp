#include "common/scene/fixture_table.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "common/scene/scene_keys.h"
#include "common/text/plain_text.h"

namespace osteomill {

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
