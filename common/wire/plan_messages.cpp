#include "common/wire/plan_messages.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "common/bone/patient_space.h"
#include "common/text/foreign_text.h"
#include "common/wire/geometry_messages.h"

namespace osteomill {

v2::Plan to_message(const Plan& plan) {
    v2::Plan message;
    message.set_margin_mm(plan.margin_mm);
    if (const auto* tissue = std::get_if<TissueRegion>(&plan.region)) message.set_tissue(tissue->tissue);
    if (const auto* sphere = std::get_if<SphereRegion>(&plan.region)) {
        write(sphere->centre_mm, *message.mutable_sphere()->mutable_centre_mm());
        message.mutable_sphere()->set_radius_mm(sphere->radius_mm);
    }
    if (const auto* cylinder = std::get_if<CylinderRegion>(&plan.region)) {
        write(cylinder->from_mm, *message.mutable_cylinder()->mutable_from_mm());
        write(cylinder->to_mm, *message.mutable_cylinder()->mutable_to_mm());
        message.mutable_cylinder()->set_radius_mm(cylinder->radius_mm);
    }
    return message;
}

std::variant<Plan, WireError> plan_from(const v2::Plan& message) {
    Plan plan{.margin_mm = message.margin_mm()};
    double radius_mm = 1.0;
    switch (message.region_case()) {
        case v2::Plan::kTissue:
            plan.region = TissueRegion{printable(message.tissue())};
            break;
        case v2::Plan::kSphere: {
            const v2::Plan::Sphere& sphere = message.sphere();
            radius_mm = sphere.radius_mm();
            if (!is_finite(read(sphere.centre_mm()))) return WireError{"the plan's sphere is nowhere"};
            plan.region = SphereRegion{read(sphere.centre_mm()), radius_mm};
            break;
        }
        case v2::Plan::kCylinder: {
            const v2::Plan::Cylinder& cylinder = message.cylinder();
            radius_mm = cylinder.radius_mm();
            const glm::dvec3 from_mm = read(cylinder.from_mm());
            const glm::dvec3 to_mm = read(cylinder.to_mm());
            const double length_mm = glm::length(to_mm - from_mm);
            if (!std::isfinite(length_mm) || !(length_mm > 0.0))
                return WireError{"the plan's cylinder has an impossible length"};
            plan.region = CylinderRegion{from_mm, to_mm, radius_mm};
            break;
        }
        case v2::Plan::REGION_NOT_SET:
            return WireError{"the plan has no region"};
    }
    if (!std::isfinite(radius_mm) || !(radius_mm > 0.0) || !std::isfinite(plan.margin_mm) ||
        plan.margin_mm < 0.0)
        return WireError{"the plan has an impossible radius or margin"};
    return plan;
}

v2::RatingItem to_message(const RatingItem& item) {
    v2::RatingItem message;
    message.set_name(item.name);
    message.set_points(item.points);
    message.set_when(item.when);
    message.set_source(item.source);
    if (item.region) *message.mutable_region() = to_message(Plan{.region = *item.region});
    return message;
}

std::variant<Rating, WireError> rating_from(
    const google::protobuf::RepeatedPtrField<v2::RatingItem>& messages) {
    if (static_cast<std::size_t>(messages.size()) > most_rating_items)
        return WireError{"the rating has " + std::to_string(messages.size()) + " items; at most " +
                         std::to_string(most_rating_items) + " are taken"};
    Rating rating;
    for (const v2::RatingItem& message : messages) {
        if (message.name().size() > longest_rating_name || message.when().size() > longest_rating_condition ||
            message.source().size() > longest_rating_source)
            return WireError{"the rating's item \"" + one_line(message.name()) + "\" has too long a text"};
        if (!(message.points() > 0.0) || !(message.points() <= most_rating_points))
            return WireError{"the rating's item \"" + one_line(message.name()) + "\" has impossible points"};
        RatingItem item{.name = printable(message.name()),
                        .points = message.points(),
                        .when = printable(message.when()),
                        .source = printable(message.source())};
        if (message.has_region()) {
            auto region = plan_from(message.region());
            if (auto* error = std::get_if<WireError>(&region)) return *error;
            item.region = std::get<0>(std::move(region)).region;
        }
        rating.push_back(std::move(item));
    }
    return rating;
}

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
