#include "imaging/phantoms/temporal_bone.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "imaging/phantoms/distance_fields.h"
#include "imaging/phantoms/noise.h"

namespace osteomill {

namespace {

namespace df = distance_field;

using Part = TemporalPart;
using Shape = AnatomyPart::Shape;

struct PathPoint {
    glm::dvec3 at_mm{0.0};
    double radius_mm = 0.0;
};

void add_path(std::vector<AnatomyPart>& parts, Part kind, std::span<const PathPoint> path) {
    for (std::size_t i = 1; i < path.size(); ++i)
        parts.push_back({kind, Shape::cone, path[i - 1].at_mm, path[i].at_mm, path[i - 1].radius_mm,
                         path[i].radius_mm, 0.5 * path[i].radius_mm});
}
void add_path(std::vector<AnatomyPart>& parts, Part kind, std::initializer_list<PathPoint> path) {
    add_path(parts, kind, std::span(path.begin(), path.size()));
}

void add_ellipsoid(std::vector<AnatomyPart>& parts, Part kind, const glm::dvec3& centre_mm,
                   const glm::dvec3& half_mm, double blend_mm) {
    parts.push_back({kind, Shape::ellipsoid, centre_mm, half_mm, 0.0, 0.0, blend_mm});
}

void add_nerves(std::vector<AnatomyPart>& parts) {
    // From the pons along the front upper part of the internal canal; labyrinthine part; first genu; tympanic
    // part over the oval window; second genu under the lateral canal; mastoid part; stylomastoid foramen.
    add_path(parts, Part::facial_nerve,
             {{{-25.0, -0.6, 4.9}, 0.55},
              {{-18.5, -0.2, 4.7}, 0.55},
              {{-9.6, -2.2, 4.9}, 0.5},
              {{-7.6, -3.9, 5.4}, 0.5},
              {{-6.6, -4.4, 5.3}, 1.0},
              {{-5.4, -2.2, 4.9}, 0.65},
              {{-4.4, 2.4, 4.1}, 0.65},
              {{-3.0, 5.6, 3.2}, 0.7},
              {{-1.6, 7.2, 1.2}, 0.72},
              {{-0.4, 7.8, -4.0}, 0.72},
              {{0.9, 7.4, -12.5}, 0.75},
              {{1.6, 6.6, -16.5}, 0.8}});
    add_path(parts, Part::chorda_tympani,
             {{{0.3, 7.6, -8.0}, 0.25},
              {{1.3, 6.0, -3.0}, 0.25},
              {{0.9, 3.8, 1.4}, 0.25},
              {{-0.4, 1.0, 3.2}, 0.25},
              {{-0.7, -1.8, 3.0}, 0.25},
              {{-1.2, -5.5, 1.8}, 0.25}});
    add_path(parts, Part::superior_vestibular,
             {{{-25.0, 1.6, 4.8}, 0.6}, {{-18.5, 1.8, 4.6}, 0.6}, {{-9.2, 0.6, 4.6}, 0.5}});
    add_path(parts, Part::inferior_vestibular,
             {{{-25.0, 1.6, 2.6}, 0.6}, {{-18.5, 1.8, 2.6}, 0.6}, {{-9.2, 0.8, 2.6}, 0.5}});
    add_path(parts, Part::cochlear_nerve,
             {{{-25.0, -0.6, 2.6}, 0.65}, {{-18.5, -0.2, 2.6}, 0.65}, {{-9.8, -2.0, 2.4}, 0.6}});
    add_path(parts, Part::iac,
             {{{-21.0, 1.4, 3.6}, 2.9}, {{-17.5, 0.7, 3.7}, 2.4}, {{-10.4, -0.8, 3.7}, 2.1}});
}

void add_labyrinth(std::vector<AnatomyPart>& parts) {
    add_ellipsoid(parts, Part::labyrinth, {-7.6, 1.9, 2.8}, {1.5, 2.5, 2.2}, 0.4);
    const auto ring = [&](const glm::dvec3& centre_mm, const glm::dvec3& axis, double radius_mm) {
        parts.push_back(
            {Part::labyrinth, Shape::ring, centre_mm, glm::normalize(axis), radius_mm, 0.55, 0.3});
    };
    ring({-6.6, 5.0, 4.6}, {0.0, 0.5, 0.866}, 2.3);   // lateral, its front end up by 30 degrees
    ring({-8.9, 6.3, 2.2}, {-0.64, 0.77, 0.0}, 3.1);  // posterior, along the pyramid's back face
    ring({-8.6, 2.2, 6.6}, {0.77, 0.64, 0.0}, 3.2);   // anterior, across the pyramid
    // Two turns and a half of the cochlea about an axis that points forwards and outwards. A turn by the
    // angle whose cosine is 0.8 and whose sine is 0.6 needs only products.
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.55, -0.8, -0.2));
    const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 up = glm::cross(across, axis);
    const glm::dvec3 base_mm(-8.4, -3.0, 1.4);
    constexpr int steps = 24;
    double cosine = -1.0, sine = 0.0;
    PathPoint before{};
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double radius_mm = 3.3 - 2.6 * t;
        const PathPoint here{base_mm + radius_mm * (cosine * across + sine * up) + 3.2 * t * axis,
                             1.05 - 0.5 * t};
        if (i > 0)
            parts.push_back({Part::labyrinth, Shape::cone, before.at_mm, here.at_mm, before.radius_mm,
                             here.radius_mm, 0.2});
        before = here;
        const double turned = 0.8 * cosine - 0.6 * sine;
        sine = 0.6 * cosine + 0.8 * sine;
        cosine = turned;
    }
    add_path(parts, Part::aqueduct,
             {{{-9.0, 3.4, 3.4}, 0.3}, {{-11.2, 5.4, 2.4}, 0.35}, {{-12.4, 7.0, 0.0}, 0.6}});
}

void add_vessels(std::vector<AnatomyPart>& parts) {
    add_path(parts, Part::carotid,
             {{{-8.5, -5.5, -20.0}, 2.5},
              {{-9.0, -6.5, -7.5}, 2.5},
              {{-11.0, -7.8, -5.6}, 2.5},
              {{-26.0, -14.0, -4.4}, 2.5}});
    // From the transverse sinus down the posterior fossa to the bulb of the jugular vein.
    for (const auto& [a, b] : std::initializer_list<std::pair<PathPoint, PathPoint>>{
             {{{14.0, 33.0, 9.5}, 5.0}, {{9.5, 25.5, 5.5}, 5.0}},
             {{{9.5, 25.5, 5.5}, 5.0}, {{6.5, 21.5, -1.5}, 5.0}},
             {{{6.5, 21.5, -1.5}, 5.0}, {{2.5, 17.5, -8.5}, 4.6}},
             {{{2.5, 17.5, -8.5}, 4.6}, {{-3.5, 11.0, -12.0}, 4.2}},
             {{{-3.5, 11.0, -12.0}, 4.2}, {{-5.5, 4.5, -9.5}, 3.8}},
             {{{-5.5, 4.5, -9.5}, 3.8}, {{-6.0, 3.0, -22.0}, 3.6}}})
        parts.push_back({Part::sinus, Shape::cone, a.at_mm, b.at_mm, a.radius_mm, b.radius_mm, 2.0});
}

void add_middle_ear(std::vector<AnatomyPart>& parts) {
    add_path(parts, Part::malleus,
             {{{-1.5, 0.4, -1.0}, 0.4}, {{-0.9, -0.6, 3.4}, 0.45}, {{-0.7, -0.9, 4.6}, 0.6}});
    add_path(parts, Part::malleus, {{{-0.7, -0.7, 3.4}, 0.4}, {{0.2, -0.9, 3.2}, 0.3}});
    add_ellipsoid(parts, Part::malleus, {-0.7, -0.8, 5.8}, {1.2, 1.2, 1.4}, 0.5);
    add_ellipsoid(parts, Part::incus, {-0.8, 1.5, 5.8}, {1.1, 1.4, 1.5}, 0.0);
    add_path(parts, Part::incus, {{{-0.8, 1.8, 6.0}, 0.95}, {{-0.2, 5.0, 5.6}, 0.4}});
    add_path(parts, Part::incus,
             {{{-0.9, 1.6, 5.2}, 0.75},
              {{-1.7, 1.9, 2.4}, 0.42},
              {{-2.1, 1.9, 1.9}, 0.4},
              {{-2.7, 1.9, 1.9}, 0.38}});
    add_path(parts, Part::stapes, {{{-3.1, 1.9, 1.95}, 0.4}, {{-3.6, 1.9, 2.1}, 0.36}});
    add_path(parts, Part::stapes,
             {{{-3.6, 1.9, 2.1}, 0.25}, {{-4.6, 0.8, 2.5}, 0.22}, {{-5.85, 0.75, 2.8}, 0.25}});
    add_path(parts, Part::stapes,
             {{{-3.6, 1.9, 2.1}, 0.25}, {{-4.6, 3.0, 2.5}, 0.24}, {{-5.85, 3.05, 2.8}, 0.27}});
    add_ellipsoid(parts, Part::stapes, {-5.95, 1.9, 2.8}, {0.28, 1.5, 0.72}, 0.2);
    add_ellipsoid(parts, Part::tympanic_cavity, {-2.2, 0.3, -0.4}, {3.4, 5.8, 6.6}, 0.0);
    // Attic, aditus and antrum.
    add_ellipsoid(parts, Part::attic, {-1.0, 0.8, 5.6}, {2.6, 4.4, 3.2}, 1.0);
    add_ellipsoid(parts, Part::attic, {-0.2, 5.5, 6.4}, {2.4, 3.2, 2.4}, 1.0);
    add_ellipsoid(parts, Part::attic, {1.4, 10.0, 6.4}, {4.2, 4.4, 4.0}, 1.0);
    parts.push_back({Part::oval_niche, Shape::ellipsoid, {-4.8, 1.9, 2.5}, {1.8, 1.9, 1.15}, 0.0, 0.0, 0.0});
}

void add_outside(std::vector<AnatomyPart>& parts) {
    add_path(parts, Part::ear_canal,
             {{{-6.0, 0.6, -0.8}, 4.6},
              {{1.0, 0.0, 0.0}, 4.3},
              {{9.0, -1.4, 0.9}, 3.7},
              {{24.0, -2.2, 1.4}, 4.6}});
    add_ellipsoid(parts, Part::fossa, {11.0, -13.5, -6.0}, {13.0, 7.4, 9.5}, 0.0);
    add_ellipsoid(parts, Part::joint, {10.0, -13.5, -2.4}, {8.0, 4.6, 5.0}, 0.0);
}

double posterior_plane_mm(const glm::dvec3& p) {
    return -0.64 * p.x + 0.77 * p.y - 13.5;
}

/// Highest over the anterior canal (arcuate eminence).
double tegmen_z_mm(const glm::dvec3& p) {
    const double arcuate = df::bump((df::squared(p.x + 8.6) + df::squared(p.y - 2.2)) / 49.0);
    return 10.8 + 1.8 * arcuate + 0.05 * p.x;
}

}  // namespace

double distance_mm(const AnatomyPart& part, const glm::dvec3& p) {
    switch (part.shape) {
        case Shape::cone:
            return df::round_cone(p, part.a_mm, part.b_mm, part.a_radius_mm, part.b_radius_mm);
        case Shape::ellipsoid:
            return df::ellipsoid(p - part.a_mm, part.b_mm);
        case Shape::ring:
            break;
    }
    const glm::dvec3 d = p - part.a_mm;
    const double along = glm::dot(d, part.b_mm);
    const double aside = glm::length(d - along * part.b_mm) - part.a_radius_mm;
    return std::sqrt(aside * aside + along * along) - part.b_radius_mm;
}

std::vector<AnatomyPart> temporal_bone_parts() {
    std::vector<AnatomyPart> parts;
    add_nerves(parts);
    add_labyrinth(parts);
    add_vessels(parts);
    add_middle_ear(parts);
    add_outside(parts);
    return parts;
}

double temporal_body_mm(const glm::dvec3& p) {
    // The outer face bulges behind the ear canal and falls back above it.
    const double face_x = 17.5 + 1.6 * df::bump((df::squared(p.y - 13.0) + df::squared(p.z + 4.0)) / 400.0) -
                          0.12 * std::max(0.0, p.z - 4.0);
    const double upper = df::smooth_intersection(
        df::smooth_intersection(p.x - face_x, p.z - tegmen_z_mm(p), 3.0),
        df::smooth_intersection(posterior_plane_mm(p), -11.5 - p.z + 0.12 * p.x, 3.0), 2.0);
    const double process = df::round_cone(p, {9.0, 14.0, -5.0}, {11.0, 10.0, -22.0}, 10.0, 5.8);
    // The squama goes on up; the root of the zygoma runs forwards from above the ear canal.
    const double squama = df::rounded_box(p - glm::dvec3(15.2 - 0.06 * p.z, 0.0, 8.0), {1.7, 24.0, 7.5}, 1.0);
    const double zygoma =
        df::smooth_union(df::round_cone(p, {15.5, 8.0, 8.0}, {16.5, -4.0, 5.8}, 1.4, 2.4),
                         df::round_cone(p, {16.5, -4.0, 5.8}, {21.0, -17.0, 6.8}, 2.6, 2.2), 2.0);
    const double styloid = df::round_cone(p, {-0.5, 3.0, -10.0}, {-1.5, 0.0, -27.0}, 2.4, 0.9);
    // Groove of the digastric muscle within the process.
    const double groove = df::round_cone(p, {2.0, 10.0, -20.0}, {3.0, 26.0, -16.0}, 2.6, 3.0);
    const double full = df::smooth_union(
        df::smooth_union(df::smooth_union(upper, process, 8.0), df::smooth_union(squama, zygoma, 2.5), 2.0),
        styloid, 1.5);
    const double body = df::smooth_intersection(full, -groove, 1.5);
    return std::abs(body) > 0.8 ? body : body + 0.2 * smooth_noise(p / 2.4);
}

double dura_mm(const glm::dvec3& p) {
    constexpr double thickness_mm = 0.9, overlap_mm = 0.2, edge_mm = 3.0;
    const double above = p.z - tegmen_z_mm(p);
    const double behind = posterior_plane_mm(p);
    const double outside = df::smooth_intersection(above, behind, 2.0);
    const double sheet = std::max(outside - thickness_mm, -outside - overlap_mm);
    return std::max(sheet, std::max(p.x - 16.0 + edge_mm, -10.0 - p.z));
}

double drum_plane_mm(const glm::dvec3& p) {
    return 0.795 * p.x - 0.348 * p.y - 0.497 * p.z;
}

double pneumatised_mm(const glm::dvec3& p) {
    return df::smooth_intersection(df::ellipsoid(p - glm::dvec3(9.0, 12.5, -3.0), {11.0, 13.0, 18.0}),
                                   1.2 - p.x + 0.25 * p.y - 4.0, 2.0);
}

namespace {

constexpr double lattice_mm = 3.0, jitter = 0.36;  // the second as a share of the first
constexpr double septum_mm = 0.32, corner_mm = 0.3;
// Cells communicate: a third of the septa has a round opening.
constexpr double opening_radius_mm = 0.55, open_share = 1.0 / 3.0;
// A cell whose middle is further from a place takes no part in its corners.
constexpr double neighbour_mm = 4.5;

AirCell cell_at(const glm::ivec3& point) {
    const auto noise = [&](int channel) { return lattice_noise(point + glm::ivec3(1000 * channel, 0, 0)); };
    return {point, lattice_mm * (glm::dvec3(point) + jitter * glm::dvec3(noise(0), noise(1), noise(2)))};
}

/// The same from either side.
bool is_open(const AirCell& one, const AirCell& other) {
    return lattice_noise(one.point + other.point + glm::ivec3(-2000, 0, 0)) < 2.0 * open_share - 1.0;
}

}  // namespace

std::vector<AirCell> air_cells_near(const glm::dvec3& place_mm, double reach_mm) {
    const double within_mm = reach_mm + neighbour_mm;
    const int steps = static_cast<int>(std::ceil(within_mm / lattice_mm + jitter));
    const glm::ivec3 middle(glm::floor(place_mm / lattice_mm + 0.5));
    std::vector<AirCell> cells;
    glm::ivec3 step;
    for (step.z = -steps; step.z <= steps; ++step.z)
        for (step.y = -steps; step.y <= steps; ++step.y)
            for (step.x = -steps; step.x <= steps; ++step.x)
                if (const AirCell cell = cell_at(middle + step);
                    glm::distance(cell.middle_mm, place_mm) < within_mm)
                    cells.push_back(cell);
    return cells;
}

double air_cells_mm(const glm::dvec3& p, const std::vector<AirCell>& cells) {
    if (cells.size() < 2) return 100.0;
    const auto away_mm = [&](const AirCell& cell) { return glm::distance(p, cell.middle_mm); };
    const AirCell& own = *std::ranges::min_element(cells, {}, away_mm);
    const double own_mm = away_mm(own);
    // By the two septa that matter most, in whichever order they come.
    double first_mm = -100.0, second_mm = -100.0;
    for (const AirCell& other : cells) {
        if (&other == &own) continue;
        double septum_at_mm = 0.5 * (septum_mm - away_mm(other) + own_mm);
        if (septum_at_mm < second_mm) continue;
        if (is_open(own, other)) {
            const glm::dvec3 way = glm::normalize(other.middle_mm - own.middle_mm);
            const double aside_mm = glm::length(glm::cross(p - own.middle_mm, way));
            septum_at_mm = std::min(septum_at_mm, aside_mm - opening_radius_mm);
        }
        second_mm = std::max(second_mm, std::min(first_mm, septum_at_mm));
        first_mm = std::max(first_mm, septum_at_mm);
    }
    return df::smooth_intersection(first_mm, second_mm, corner_mm);
}

}  // namespace osteomill
