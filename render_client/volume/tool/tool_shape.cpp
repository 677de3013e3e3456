#include "render_client/volume/tool/tool_shape.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/scene/burr_profile.h"

namespace osteomill {

namespace {

constexpr glm::vec3 bright_steel(0.62f, 0.64f, 0.67f);
constexpr glm::vec3 groove_steel(0.16f, 0.17f, 0.19f);
constexpr glm::vec3 shank_steel(0.48f, 0.50f, 0.53f);
constexpr glm::vec3 body_steel(0.34f, 0.35f, 0.37f);
constexpr glm::vec3 grip_grey(0.075f, 0.08f, 0.09f);

// Shanks of dental burrs: 1.6 mm for the turbine, 2.35 mm for the straight handpiece (ISO 1797).
constexpr double turbine_shank_radius_mm = 0.8;
constexpr double handpiece_shank_radius_mm = 1.175;
constexpr double shank_length_mm = 18.0;
/// A thicker part of a burr's profile is the handpiece, which does not turn.
constexpr double thickest_shank_radius_mm = 3.0;

/// A closed grid of quads: `columns` round the z axis, one row a station, each point given by a function.
Triangles wrap(int rows, int columns, const std::function<Vertex(int row, double angle_rad)>& point) {
    Triangles triangles;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            triangles.vertices.push_back(point(row, 2.0 * std::numbers::pi * column / columns));
    const auto index = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * columns + column % columns);
    };
    for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const std::uint32_t a = index(row, column), b = index(row, column + 1);
            const std::uint32_t c = index(row + 1, column), d = index(row + 1, column + 1);
            triangles.indices.insert(triangles.indices.end(), {a, b, d, a, d, c});
        }
    return triangles;
}

/// Normals by area-weighted averages of the triangles that meet in a vertex.
void smooth_normals(Triangles& triangles) {
    for (Vertex& vertex : triangles.vertices) vertex.normal = glm::vec3(0.0f);
    for (std::size_t first = 0; first < triangles.indices.size(); first += 3) {
        Vertex& a = triangles.vertices[triangles.indices[first]];
        Vertex& b = triangles.vertices[triangles.indices[first + 1]];
        Vertex& c = triangles.vertices[triangles.indices[first + 2]];
        const glm::vec3 normal = glm::cross(b.position - a.position, c.position - a.position);
        a.normal += normal;
        b.normal += normal;
        c.normal += normal;
    }
    for (Vertex& vertex : triangles.vertices) {
        const float length = glm::length(vertex.normal);
        vertex.normal = length > 0.0f ? vertex.normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
    }
}

void append(Triangles& whole, const Triangles& part) {
    const auto offset = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const std::uint32_t index : part.indices) whole.indices.push_back(index + offset);
}

struct Station {
    double z;
    double radius;
};

using ColourRound = std::function<glm::vec3(double angle_rad)>;

/// A body of revolution; each pair of stations is a band of its own, so that edges between bands stay sharp.
Triangles lathe(const std::vector<Station>& stations, const ColourRound& colour) {
    Triangles body;
    for (std::size_t band = 0; band + 1 < stations.size(); ++band) {
        Triangles part = wrap(2, 32, [&](int row, double angle_rad) {
            const Station& station = stations[band + static_cast<std::size_t>(row)];
            return Vertex{
                {station.radius * std::cos(angle_rad), station.radius * std::sin(angle_rad), station.z},
                {},
                colour(angle_rad)};
        });
        smooth_normals(part);
        append(body, part);
    }
    return body;
}

/// Part of the contrast of flutes and marks that is seen.
double contrast(BurrMotion motion) {
    return motion == BurrMotion::still ? 1.0 : 0.2;
}

/// A smooth shank would not show that it turns: two dark marks do, also while the burr is out of sight.
ColourRound marked_shank(BurrMotion motion) {
    constexpr double half_mark = 0.35;  // sine of half of a mark's angle
    const double mean = 2.0 / std::numbers::pi * std::asin(half_mark);
    return [=](double angle_rad) {
        const double mark = std::abs(std::sin(angle_rad)) < half_mark ? 1.0 : 0.0;
        return glm::mix(shank_steel, groove_steel,
                        static_cast<float>(std::lerp(mean, mark, contrast(motion))));
    };
}

/// `share` at the bottom of a flute, 0 on the land between two. Flutes wind round the axis.
double groove_depth(const BurrShape& burr, double angle_rad, double winding_rad, double share) {
    const double winding = burr.clockwise ? -1.0 : 1.0;
    const double phase = burr.edges * (angle_rad + winding * 0.6 * winding_rad);
    return std::pow(0.5 + 0.5 * std::cos(phase), 3.0) * share;
}

/// Depth of a flute, as a share of the head's radius. At speed the land sweeps over it.
double flute_depth(BurrMotion motion) {
    return motion == BurrMotion::still ? 0.14 : 0.0;
}

/// `share` is that of groove_depth at this place.
glm::vec3 steel_of(double groove, double share, BurrMotion motion) {
    constexpr double mean_over_a_turn = 5.0 / 16.0;  // of (1/2 + cos / 2)^3
    return glm::mix(bright_steel, groove_steel,
                    static_cast<float>(std::lerp(mean_over_a_turn * share, groove, contrast(motion))));
}

Triangles fluted_sphere(const BurrShape& burr, BurrMotion motion) {
    constexpr int rows = 40;
    const double radius = 0.5 * burr.diameter_mm;
    Triangles sphere = wrap(rows, 120, [&](int row, double angle_rad) {
        const double from_tip_rad = std::numbers::pi * row / (rows - 1);
        const double share = std::sin(from_tip_rad);
        const double groove = groove_depth(burr, angle_rad, from_tip_rad, share);
        const double r = radius * (1.0 - flute_depth(motion) * groove);
        const double around = r * std::sin(from_tip_rad);
        return Vertex{
            {around * std::cos(angle_rad), around * std::sin(angle_rad), -r * std::cos(from_tip_rad)},
            {},
            steel_of(groove, share, motion)};
    });
    smooth_normals(sphere);
    return sphere;
}

/// A fluted head that is no ball: along its outline, with flutes that fade where a face nears the spindle.
Triangles fluted_head(const BurrShape& burr, const BurrProfile& profile, BurrMotion motion) {
    constexpr int rows = 96;
    const double radius = 0.5 * burr.diameter_mm;
    Triangles head = wrap(rows, 120, [&](int row, double angle_rad) {
        const OutlinePoint point = profile.outline_at(profile.outline_length() * row / (rows - 1));
        const double winding_rad = (point.height - profile.tip_height()) / radius;
        const double share = std::min(1.0, point.radius / radius);
        const double groove = groove_depth(burr, angle_rad, winding_rad, share);
        const double cut_mm = flute_depth(motion) * radius * groove;
        const double around = point.radius - cut_mm * point.out;
        return Vertex{
            {around * std::cos(angle_rad), around * std::sin(angle_rad), point.height - cut_mm * point.up},
            {},
            steel_of(groove, share, motion)};
    });
    smooth_normals(head);
    return head;
}

/// From within the head to the end, upwards.
std::vector<Station> shank_of(const BurrShape& burr) {
    const double radius = 0.5 * burr.diameter_mm;
    const double into_head_mm = 0.1 * burr.diameter_mm;
    std::vector<Station> of_profile;
    for (const ShankPoint& point : burr.shank) {
        if (point.radius_mm > thickest_shank_radius_mm) break;
        if (of_profile.empty()) of_profile.push_back({point.height_mm - into_head_mm, point.radius_mm});
        of_profile.push_back({point.height_mm, point.radius_mm});
    }
    if (of_profile.size() > 2) return of_profile;
    double head_end_mm = radius;
    double neck_mm = 0.45 * radius;
    if (burr.head.shape != HeadShape::ball) {
        head_end_mm = BurrProfile(burr.head, burr.diameter_mm).top_height();
        neck_mm = std::min(neck_mm, 0.4 * burr.head.neck_diameter_mm);
    }
    const double shank_mm = radius > 1.0 ? handpiece_shank_radius_mm : turbine_shank_radius_mm;
    const double neck_end_mm = head_end_mm + std::max(2.0, 1.2 * radius);
    const double taper_end_mm = neck_end_mm + 3.0;
    return {{head_end_mm - into_head_mm, neck_mm},
            {neck_end_mm, neck_mm},
            {taper_end_mm, shank_mm},
            {taper_end_mm + shank_length_mm, shank_mm}};
}

}  // namespace

Triangles burr_head(const BurrShape& burr, BurrMotion motion) {
    if (burr.head.shape == HeadShape::ball) return fluted_sphere(burr, motion);
    return fluted_head(burr, BurrProfile(burr.head, burr.diameter_mm), motion);
}

Triangles burr_shank(const BurrShape& burr, BurrMotion motion) {
    std::vector<Station> stations = shank_of(burr);
    stations.push_back({stations.back().z, 0.0});
    return lathe(stations, marked_shank(motion));
}

Triangles handpiece(const BurrShape& burr) {
    const double from_mm = shank_of(burr).back().z;
    // Heights above the end of the shank, which ends within the nose.
    const auto part = [&](std::vector<Station> stations, const glm::vec3& linear_rgb) {
        for (Station& station : stations) station.z += from_mm;
        return lathe(stations, [=](double) { return linear_rgb; });
    };
    Triangles whole =
        part({{-0.5, 0.0}, {-0.5, 1.9}, {0.5, 2.4}, {7.0, 2.9}, {8.0, 4.2}, {18.0, 5.6}}, body_steel);
    constexpr int ribs = 8;
    constexpr double rib_mm = 2.6;
    double z = 18.0;
    for (int rib = 0; rib < ribs; ++rib, z += rib_mm) {
        append(whole, part({{z, 5.6}, {z + 0.4, 6.1}, {z + 1.6, 6.1}, {z + 2.0, 5.6}}, grip_grey));
        append(whole, part({{z + 2.0, 5.6}, {z + rib_mm, 5.6}}, body_steel));
    }
    append(whole,
           part({{z, 5.6}, {z + 6.0, 7.0}, {z + 45.0, 8.6}, {z + 52.0, 7.8}, {z + 54.0, 4.0}}, body_steel));
    append(whole, part({{z + 54.0, 4.0}, {z + 66.0, 2.6}, {z + 110.0, 2.6}, {z + 110.0, 0.0}}, grip_grey));
    return whole;
}

Triangles unit_arrow(const glm::vec3& linear_rgb) {
    return lathe({{0.0, 0.0}, {0.0, 0.03}, {0.72, 0.03}, {0.72, 0.085}, {1.0, 0.0}},
                 [&](double) { return linear_rgb; });
}

Triangles unit_sphere(const glm::vec3& linear_rgb) {
    constexpr int rows = 20;
    Triangles sphere = wrap(rows, 32, [&](int row, double angle_rad) {
        const double from_tip_rad = std::numbers::pi * row / (rows - 1);
        const double around = std::sin(from_tip_rad);
        return Vertex{{around * std::cos(angle_rad), around * std::sin(angle_rad), -std::cos(from_tip_rad)},
                      {},
                      linear_rgb};
    });
    smooth_normals(sphere);
    return sphere;
}

}  // namespace osteomill
