#include "common/wire/fixture_message.h"

#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "common/bone/finite.h"
#include "common/bone/patient_space.h"
#include "common/text/plain_text.h"
#include "common/wire/vec3.h"

namespace osteomill {

namespace {

bool is_length(double mm) {
    return mm >= 0.0 && mm <= 1000.0;
}

/// Nothing: it cannot be.
std::optional<LineGuide> line_from(const v2::FixtureDescription::Line& message) {
    const LineGuide line{read(message.from_mm()), read(message.to_mm())};
    if (!is_finite(line.from_mm) || !is_finite(line.to_mm) || !unit_direction(line.to_mm - line.from_mm))
        return std::nullopt;
    return line;
}

std::optional<PlaneGuide> plane_from(const v2::FixtureDescription::Plane& message) {
    const std::optional<glm::dvec3> normal = unit_direction(read(message.normal()));
    const glm::dvec3 at_mm = read(message.at_mm());
    if (!is_finite(at_mm) || !normal) return std::nullopt;
    return PlaneGuide{at_mm, *normal};
}

/// Nothing: it cannot be.
std::optional<Fixture> fixture_from(const v2::FixtureDescription& message) {
    Fixture fixture = usual_fixture(FixtureKind::guide);
    switch (message.shape_case()) {
        case v2::FixtureDescription::kLine: {
            const std::optional<LineGuide> line = line_from(message.line());
            if (!line) return std::nullopt;
            fixture.path = *line;
            break;
        }
        case v2::FixtureDescription::kPlane: {
            const std::optional<PlaneGuide> plane = plane_from(message.plane());
            if (!plane) return std::nullopt;
            fixture.path = *plane;
            break;
        }
        case v2::FixtureDescription::kRegion: {
            const v2::FixtureDescription::Region& region = message.region();
            fixture = usual_fixture(region.slows() ? FixtureKind::slow : FixtureKind::forbidden);
            fixture.tissue = printable(region.tissue());
            fixture.distance_mm = region.distance_mm();
            break;
        }
        case v2::FixtureDescription::SHAPE_NOT_SET:
            fixture = usual_fixture(FixtureKind::slow);
            break;
    }
    fixture.name = printable(message.name());
    fixture.radius_mm = message.radius_mm();
    fixture.reach_mm = message.reach_mm();
    if (!is_length(fixture.radius_mm) || !is_length(fixture.reach_mm) || !is_length(fixture.distance_mm))
        return std::nullopt;
    return fixture;
}

}  // namespace

v2::FixtureDescription to_message(const Fixture& fixture) {
    v2::FixtureDescription message;
    message.set_name(fixture.name);
    if (fixture.kind != FixtureKind::guide) {
        v2::FixtureDescription::Region& region = *message.mutable_region();
        region.set_tissue(fixture.tissue);
        region.set_distance_mm(fixture.distance_mm);
        region.set_slows(fixture.kind == FixtureKind::slow);
        return message;
    }
    message.set_radius_mm(fixture.radius_mm);
    message.set_reach_mm(fixture.reach_mm);
    if (const auto* line = std::get_if<LineGuide>(&fixture.path)) {
        write(line->from_mm, *message.mutable_line()->mutable_from_mm());
        write(line->to_mm, *message.mutable_line()->mutable_to_mm());
    }
    if (const auto* plane = std::get_if<PlaneGuide>(&fixture.path)) {
        write(plane->at_mm, *message.mutable_plane()->mutable_at_mm());
        write(plane->normal, *message.mutable_plane()->mutable_normal());
    }
    return message;
}

std::variant<std::vector<Fixture>, WireError> fixtures_from(
    const google::protobuf::RepeatedPtrField<v2::FixtureDescription>& messages) {
    if (static_cast<std::size_t>(messages.size()) > most_fixtures)
        return WireError{"the scene has " + std::to_string(messages.size()) + " fixtures; at most " +
                         std::to_string(most_fixtures) + " are taken"};
    std::vector<Fixture> fixtures;
    for (const v2::FixtureDescription& message : messages) {
        const std::string name = one_line(message.name());
        if (name.empty() || message.name().size() > longest_fixture_name)
            return WireError{"a fixture has a name of " + std::to_string(message.name().size()) +
                             " bytes; it must have 1 to " + std::to_string(longest_fixture_name)};
        std::optional<Fixture> fixture = fixture_from(message);
        if (!fixture) return WireError{"the fixture \"" + name + "\" has an impossible place or length"};
        fixtures.push_back(*std::move(fixture));
    }
    return fixtures;
}

}  // namespace osteomill
