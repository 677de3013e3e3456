#include "imaging/phantoms/tooth_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "imaging/phantoms/distance_fields.h"

namespace osteomill {

namespace {

namespace df = distance_field;

/// Half an extent of the crown at a height, 0 at the cervix to 1: grows to its greatest at `widest`, then
/// shrinks to the chewing surface.
double half_extent(double cervix, double greatest, double top, double widest, double height) {
    const double below = 1.0 - height / widest;
    const double above = (height - widest) / (1.0 - widest);
    return below > 0.0 ? greatest - (greatest - cervix) * df::squared(std::min(below, 1.0))
                       : greatest - (greatest - top) * df::squared(std::min(above, 1.2));
}

double chewing_height_mm(const ToothShape& tooth, const glm::dvec3& p) {
    constexpr double tip_rounding = 0.4, groove_blend_mm = 0.35;
    double depth = 100.0;
    for (const Cusp& cusp : tooth.cusps) {
        const double x = cusp.slope_x * (p.x - cusp.tip_mm.x);
        const double y = cusp.slope_y * (p.y - cusp.tip_mm.y);
        const double fall = std::sqrt(x * x + y * y + df::squared(tip_rounding)) - tip_rounding;
        depth = df::smooth_union(depth, fall - cusp.tip_mm.z, groove_blend_mm);
    }
    return -depth;
}

double crown_distance_mm(const ToothShape& tooth, const glm::dvec3& p) {
    const double height = p.z / tooth.crown_mm;
    const double half_width = half_extent(0.5 * tooth.cervix_width_mm, 0.5 * tooth.crown_width_mm,
                                          0.5 * tooth.top_width * tooth.crown_width_mm, 0.65, height);
    const double cheek = p.y > 0.0 ? 1.0 : 0.0;
    double half_depth =
        half_extent(0.5 * tooth.cervix_depth_mm, 0.5 * tooth.crown_depth_mm,
                    0.5 * (cheek > 0.0 ? tooth.top_cheek : tooth.top_tongue) * tooth.crown_depth_mm,
                    cheek > 0.0 ? 0.33 : 0.5, height);
    for (const double groove_x : tooth.cheek_grooves_x_mm)
        half_depth -=
            0.4 * cheek * std::clamp(height, 0.0, 1.0) * df::bump(df::squared((p.x - groove_x) / 1.1));
    const double u = df::squared(p.x / half_width);
    const double v = df::squared(p.y / half_depth);
    const double round = std::sqrt(u + v);
    const double square = std::sqrt(std::sqrt(u * u + v * v));
    const double wall = (glm::mix(round, square, tooth.squareness) - 1.0) * std::min(half_width, half_depth);
    // The slopes make the height steeper than a distance.
    const double top = 0.8 * (p.z - chewing_height_mm(tooth, p));
    return df::smooth_intersection(df::smooth_intersection(wall, top, 1.3), -1.0 - p.z, 0.8);
}

double piece_distance_mm(const RootPiece& piece, const glm::dvec3& p) {
    const double dx = piece.to_mm.x - piece.from_mm.x;
    const double dz = piece.to_mm.z - piece.from_mm.z;
    const double x = p.x - piece.from_mm.x;
    const double z = p.z - piece.from_mm.z;
    const double t = std::clamp((x * dx + z * dz) / (dx * dx + dz * dz), 0.0, 1.0);
    const double aside =
        std::max(std::abs(p.y) - glm::mix(piece.from_half_width_mm, piece.to_half_width_mm, t), 0.0);
    return std::sqrt(df::squared(x - t * dx) + df::squared(z - t * dz) + aside * aside) -
           glm::mix(piece.from_radius_mm, piece.to_radius_mm, t);
}

RootPiece piece(double from_x, double from_z, double to_x, double to_z, double from_radius, double to_radius,
                double from_half_width, double to_half_width) {
    return {{from_x, 0.0, from_z}, {to_x, 0.0, to_z}, from_radius, to_radius, from_half_width, to_half_width};
}

ToothShape canine() {
    return {.crown_mm = 11.0,
            .crown_width_mm = 7.0,
            .crown_depth_mm = 7.5,
            .cervix_width_mm = 5.5,
            .cervix_depth_mm = 7.0,
            .top_width = 0.7,
            .top_cheek = 0.45,
            .top_tongue = 0.2,
            .squareness = 0.1,
            .cervix_rise_mm = 2.0,
            .cusps = {{{-0.3, 0.4, 11.3}, 0.62, 1.1}},
            .cheek_grooves_x_mm = {},
            .roots = {piece(0.0, -0.5, 0.0, -8.0, 2.55, 2.05, 0.95, 0.9),
                      piece(0.0, -8.0, 0.6, -15.1, 2.05, 0.9, 0.9, 0.2)},
            .chamber_mm = {0.0, 0.0, 2.5},
            .chamber_half_mm = {0.55, 0.7, 3.6},
            .canals = {piece(0.0, 0.0, 0.0, -8.0, 0.42, 0.3, 0.5, 0.3),
                       piece(0.0, -8.0, 0.6, -15.2, 0.3, 0.12, 0.3, 0.0)}};
}

ToothShape first_premolar() {
    return {.crown_mm = 8.5,
            .crown_width_mm = 7.0,
            .crown_depth_mm = 7.5,
            .cervix_width_mm = 5.0,
            .cervix_depth_mm = 6.5,
            .squareness = 0.15,
            .cusps = {{{-0.2, 1.2, 8.7}, 0.55, 0.7},
                      {{0.0, -2.2, 6.2}, 0.6, 0.6},
                      {{-2.7, -0.4, 6.4}, 0.5, 0.6},
                      {{2.7, -0.4, 6.3}, 0.5, 0.6}},
            .cheek_grooves_x_mm = {},
            .roots = {piece(0.0, -0.5, 0.0, -7.0, 2.3, 1.9, 0.85, 0.7),
                      piece(0.0, -7.0, 0.8, -13.2, 1.9, 0.8, 0.7, 0.1)},
            .chamber_mm = {0.0, 0.2, 1.2},
            .chamber_half_mm = {0.6, 0.9, 2.6},
            .canals = {piece(0.0, 0.0, 0.0, -7.0, 0.45, 0.3, 0.6, 0.2),
                       piece(0.0, -7.0, 0.8, -13.3, 0.3, 0.12, 0.2, 0.0)}};
}

ToothShape second_premolar() {
    return {.crown_mm = 8.0,
            .crown_width_mm = 7.0,
            .crown_depth_mm = 8.0,
            .cervix_width_mm = 5.0,
            .cervix_depth_mm = 7.0,
            .squareness = 0.3,
            .cusps = {{{-0.2, 1.6, 8.2}, 0.6, 0.65},
                      {{-1.3, -2.2, 7.4}, 0.65, 0.6},
                      {{1.5, -2.2, 7.0}, 0.65, 0.6},
                      {{-2.8, -0.1, 6.8}, 0.5, 0.5},
                      {{2.8, -0.1, 6.7}, 0.5, 0.5}},
            .cheek_grooves_x_mm = {},
            .roots = {piece(0.0, -0.5, 0.0, -7.0, 2.3, 1.95, 1.1, 0.8),
                      piece(0.0, -7.0, 0.7, -13.7, 1.95, 0.8, 0.8, 0.1)},
            .chamber_mm = {0.0, 0.1, 0.9},
            .chamber_half_mm = {0.6, 1.1, 2.2},
            .canals = {piece(0.0, 0.0, 0.0, -7.0, 0.45, 0.3, 0.7, 0.2),
                       piece(0.0, -7.0, 0.7, -13.8, 0.3, 0.12, 0.2, 0.0)}};
}

ToothShape first_molar() {
    return {.crown_mm = 7.5,
            .crown_width_mm = 11.0,
            .crown_depth_mm = 10.5,
            .cervix_width_mm = 9.0,
            .cervix_depth_mm = 9.0,
            .top_width = 0.84,
            .squareness = 0.65,
            .cusps = {{{-2.9, 2.5, 7.5}, 0.65, 0.6},
                      {{0.9, 2.7, 7.4}, 0.7, 0.6},
                      {{3.9, 1.3, 6.9}, 0.6, 0.6},
                      {{-2.7, -2.9, 7.8}, 0.62, 0.6},
                      {{2.3, -2.9, 7.7}, 0.62, 0.6},
                      {{-4.5, 0.0, 6.5}, 0.6, 0.4},
                      {{4.5, -1.0, 6.3}, 0.6, 0.5}},
            .cheek_grooves_x_mm = {-1.0, 2.8},
            .roots = {piece(-2.4, -1.0, -3.5, -7.0, 2.15, 1.5, 2.3, 1.9),
                      piece(-3.5, -7.0, -2.9, -13.2, 1.5, 0.8, 1.9, 1.0),
                      piece(2.4, -1.0, 3.6, -7.0, 2.15, 1.5, 2.1, 1.2),
                      piece(3.6, -7.0, 3.8, -12.7, 1.5, 0.8, 1.2, 0.4)},
            .chamber_mm = {0.0, 0.0, 0.3},
            .chamber_half_mm = {2.7, 1.8, 0.85},
            .canals = {piece(-2.3, -0.2, -3.5, -7.0, 0.4, 0.22, 1.7, 1.5),
                       piece(-3.5, -7.0, -2.9, -13.2, 0.22, 0.12, 1.5, 0.6),
                       piece(2.3, -0.2, 3.6, -7.0, 0.45, 0.28, 1.3, 0.5),
                       piece(3.6, -7.0, 3.8, -12.7, 0.28, 0.12, 0.5, 0.0),
                       piece(-2.4, 0.4, -2.6, 1.5, 0.4, 0.2, 1.5, 1.7),
                       piece(2.3, 0.4, 2.5, 1.4, 0.4, 0.2, 1.4, 1.6)}};
}

ToothShape second_molar() {
    return {.crown_mm = 7.0,
            .crown_width_mm = 10.5,
            .crown_depth_mm = 10.0,
            .cervix_width_mm = 8.0,
            .cervix_depth_mm = 9.0,
            .top_width = 0.82,
            .squareness = 0.65,
            .cusps = {{{-2.4, 2.5, 7.2}, 0.65, 0.6},
                      {{2.2, 2.4, 7.0}, 0.65, 0.6},
                      {{-2.4, -2.7, 7.3}, 0.65, 0.6},
                      {{2.2, -2.7, 7.1}, 0.65, 0.6},
                      {{-4.3, 0.0, 6.0}, 0.6, 0.4},
                      {{4.2, 0.0, 5.9}, 0.6, 0.4}},
            .cheek_grooves_x_mm = {0.0},
            .roots = {piece(-2.0, -1.0, -2.4, -6.5, 2.0, 1.45, 2.3, 1.8),
                      piece(-2.4, -6.5, -1.5, -12.2, 1.45, 0.8, 1.8, 0.9),
                      piece(2.0, -1.0, 2.6, -6.5, 2.0, 1.45, 2.1, 1.2),
                      piece(2.6, -6.5, 2.9, -11.7, 1.45, 0.8, 1.2, 0.4)},
            .chamber_mm = {0.0, 0.0, 0.1},
            .chamber_half_mm = {2.1, 1.5, 0.7},
            .canals = {piece(-1.9, -0.2, -2.4, -6.5, 0.35, 0.2, 1.5, 1.4),
                       piece(-2.4, -6.5, -1.5, -12.2, 0.2, 0.12, 1.4, 0.5),
                       piece(1.9, -0.2, 2.6, -6.5, 0.4, 0.25, 1.2, 0.5),
                       piece(2.6, -6.5, 2.9, -11.7, 0.25, 0.12, 0.5, 0.0),
                       piece(-1.9, 0.2, -2.0, 1.1, 0.35, 0.2, 1.3, 1.5),
                       piece(1.9, 0.2, 2.0, 1.0, 0.35, 0.2, 1.2, 1.4)}};
}

}  // namespace

double tooth_distance_mm(const ToothShape& tooth, const glm::dvec3& p) {
    constexpr double neck_blend_mm = 1.2, fork_blend_mm = 1.6;
    // Beyond this distance from the cervix the other part is too far off to be blended with.
    constexpr double roots_only_z_mm = -2.5, crown_only_z_mm = 3.4;
    const double crown = p.z < roots_only_z_mm ? 100.0 : crown_distance_mm(tooth, p);
    if (p.z > crown_only_z_mm) return crown;
    double roots = 100.0;
    for (const RootPiece& root : tooth.roots)
        roots = df::smooth_union(roots, piece_distance_mm(root, p), fork_blend_mm);
    return df::smooth_union(crown, roots, neck_blend_mm);
}

double pulp_distance_mm(const ToothShape& tooth, const glm::dvec3& p) {
    const double rounding = std::min(
        0.6, std::min(tooth.chamber_half_mm.x, std::min(tooth.chamber_half_mm.y, tooth.chamber_half_mm.z)));
    double pulp = df::rounded_box(p - tooth.chamber_mm, tooth.chamber_half_mm, rounding);
    for (const RootPiece& canal : tooth.canals)
        pulp = df::smooth_union(pulp, piece_distance_mm(canal, p), 0.4);
    return pulp;
}

double enamel_thickness_mm(const ToothShape& tooth, const glm::dvec3& p) {
    constexpr double thickest_mm = 2.2;
    const double ends_z_mm =
        tooth.cervix_rise_mm * std::min(df::squared(p.x / (0.5 * tooth.crown_width_mm)), 1.0);
    const double up = std::clamp((p.z - ends_z_mm) / (0.75 * tooth.crown_mm), 0.0, 1.0);
    return thickest_mm * up;
}

std::vector<ToothShape> lower_left_teeth() {
    return {canine(), first_premolar(), second_premolar(), first_molar(), second_molar()};
}

}  // namespace osteomill
