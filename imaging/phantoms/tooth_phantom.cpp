#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "imaging/phantoms/distance_fields.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

namespace df = distance_field;

// CT numbers: enamel, dentine and pulp as measured in children's teeth (2071 to 2955, 1323 to 1899, 184 to
// 420 HU); the lesion lies well below dentine; canal contents just above the threshold, so that they are
// there to be hurt.
constexpr double ligament_hu = 60.0;
constexpr double enamel_hu = 2500.0;
constexpr double dentine_hu = 1600.0;
constexpr double pulp_hu = 300.0;
constexpr double lesion_hu = 650.0;
constexpr double nerve_hu = 190.0;
constexpr double cortical_hu = 1600.0;
constexpr double trabecular_hu = 450.0;
constexpr double trabecular_variation_hu = 120.0;

constexpr double cervix_z_mm = -1.6;  // where enamel ends
constexpr double ligament_mm = 0.2;
constexpr double cortical_mm = 1.8;

/// 1 at t = 0, falling smoothly to 0 at t = 1; t is a squared distance over a squared radius.
double bump(double t) {
    const double rest = std::max(0.0, 1.0 - t);
    return rest * rest;
}

double occlusal_height_mm(double x, double y) {
    double height = 3.0;
    for (const double cusp_x : {-2.5, 2.5})
        for (const double cusp_y : {-2.2, 2.2}) {
            const double dx = x - cusp_x;
            const double dy = y - cusp_y;
            height += 1.0 * bump((dx * dx + dy * dy) / 9.0);
        }
    // Fissures: a groove along the row of teeth and one across.
    return height - 0.45 * bump(y * y / 0.49) - 0.3 * bump(x * x / 0.36);
}

double crown_mm(const glm::dvec3& p) {
    const double bulge = 1.0 - 0.022 * (p.z - 1.0) * (p.z - 1.0);
    const double x = p.x / 5.1;
    const double y = p.y / 4.6;
    const double wall = 4.8 * (std::sqrt(std::sqrt(x * x * x * x + y * y * y * y)) - bulge);
    const double top =
        0.85 * (p.z - occlusal_height_mm(p.x, p.y));  // slopes make the height field steeper than a distance
    return df::smooth_intersection(df::smooth_intersection(wall, top, 1.2), -2.2 - p.z, 0.6);
}

double roots_mm(const glm::dvec3& p) {
    const double mesial = df::round_cone(p, {-2.1, 0.0, -1.9}, {-3.0, 0.2, -6.4}, 2.6, 0.9);
    const double distal = df::round_cone(p, {2.1, 0.0, -1.9}, {3.1, -0.2, -6.2}, 2.6, 0.9);
    return df::smooth_union(mesial, distal, 1.0);
}

double tooth_mm(const glm::dvec3& p) {
    return df::smooth_union(crown_mm(p), roots_mm(p), 1.2);
}

double pulp_mm(const glm::dvec3& p) {
    const double chamber = df::rounded_box(p - glm::dvec3(0.0, 0.0, -1.0), {2.5, 1.8, 0.8}, 0.6);
    const double mesial = df::round_cone(p, {-2.0, 0.0, -1.4}, {-2.95, 0.2, -6.2}, 0.5, 0.2);
    const double distal = df::round_cone(p, {2.0, 0.0, -1.4}, {3.05, -0.2, -6.0}, 0.5, 0.2);
    return df::smooth_union(chamber, std::min(mesial, distal), 0.5);
}

double lesion_mm(const glm::dvec3& p) {
    return df::ellipsoid(p - glm::dvec3(0.5, 0.2, 3.0), {2.0, 1.9, 2.3});
}

double jaw_mm(const glm::dvec3& p) {
    return df::rounded_box(p - glm::dvec3(0.0, 0.0, -5.1), {23.0, 7.5, 3.1}, 2.4);
}

double nerve_canal_mm(const glm::dvec3& p) {
    const double y = 4.0 + 0.002 * p.x * p.x;
    const double dy = p.y - y;
    const double dz = p.z + 5.6;
    return std::sqrt(dy * dy + dz * dz) - 0.8;
}

/// A whole number from a lattice point, well mixed (splitmix64), as a share of 1 between -1 and 1.
double lattice_noise(const glm::ivec3& point) {
    auto bits = static_cast<std::uint64_t>(point.x + 4096) +
                (static_cast<std::uint64_t>(point.y + 4096) << 16U) +
                (static_cast<std::uint64_t>(point.z + 4096) << 32U);
    bits += 0x9e3779b97f4a7c15U;
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    bits ^= bits >> 31U;
    return static_cast<double>(bits >> 11U) / static_cast<double>(1ULL << 52U) - 1.0;
}

/// Gently varying density of the spongy bone: noise on a lattice of 0.8 mm, trilinear in between.
double trabecular_texture(const glm::dvec3& p) {
    const glm::dvec3 at = p / 0.8;
    const glm::dvec3 base = glm::floor(at);
    const glm::dvec3 w = at - base;
    const glm::ivec3 first(base);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::dvec3 share = glm::mix(1.0 - w, w, glm::dvec3(step));
        sum += share.x * share.y * share.z * lattice_noise(first + step);
    }
    return sum;
}

struct Material {
    ToothTissue tissue;
    double hu;
};

Material material_of_tooth(const glm::dvec3& p, double tooth) {
    if (lesion_mm(p) < 0.0) return {ToothTissue::carious_lesion, lesion_hu};
    if (pulp_mm(p) < 0.0) return {ToothTissue::pulp, pulp_hu};
    const double enamel_thickness_mm = 1.7 * std::clamp((p.z - cervix_z_mm) / 3.0, 0.0, 1.0);
    if (-tooth < enamel_thickness_mm) return {ToothTissue::enamel, enamel_hu};
    return {ToothTissue::dentine, dentine_hu};
}

Material material_of_jaw(const glm::dvec3& p, double jaw, double tooth) {
    if (nerve_canal_mm(p) < 0.0) return {ToothTissue::nerve_canal, nerve_hu};
    // The socket is lined with cortical bone too (lamina dura), thinner than the shell.
    if (-jaw < cortical_mm || tooth < ligament_mm + 0.4) return {ToothTissue::cortical_bone, cortical_hu};
    return {ToothTissue::trabecular_bone, trabecular_hu + trabecular_variation_hu * trabecular_texture(p)};
}

/// HU that passes the threshold exactly on the surface and reaches the material one voxel inside, air one
/// voxel outside.
double across_surface(double material_hu, double outside_hu, double distance_voxels) {
    return distance_voxels < 0.0
               ? phantom_threshold_hu + (material_hu - phantom_threshold_hu) * std::min(1.0, -distance_voxels)
               : phantom_threshold_hu + (outside_hu - phantom_threshold_hu) * std::min(1.0, distance_voxels);
}

struct Distances {
    double tooth_mm;
    double socket_mm;  ///< of the jaw with the hole for the tooth
    double nearest_mm() const { return std::min(tooth_mm, socket_mm); }
};

bool is_near_tooth(const glm::dvec3& p) {
    return std::abs(p.x) < 7.0 && std::abs(p.y) < 6.5;
}

/// The bodies' own measures of distance, which blending and slopes stretch.
Distances distances_at(const glm::dvec3& p) {
    const double tooth = is_near_tooth(p) ? tooth_mm(p) : 1.0;
    return {tooth, std::max(jaw_mm(p), ligament_mm - tooth)};
}

/// Distance from the surface to first order: the measure over its slope.
double surface_distance_mm(const glm::dvec3& p, double spacing_mm) {
    const double measure = distances_at(p).nearest_mm();
    // Far off it does not matter, and slopes are between a half and two.
    if (std::abs(measure) > 2.0 * spacing_mm) return measure;
    const double step_mm = 0.25 * spacing_mm;
    glm::dvec3 rise(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = step_mm;
        rise[axis] = distances_at(p + step).nearest_mm() - distances_at(p - step).nearest_mm();
    }
    return measure / std::max(glm::length(rise) / (2.0 * step_mm), 0.5);
}

void fill_slice(const Grid& grid, int z, std::span<std::int16_t> hu, std::span<std::uint8_t> tissue) {
    std::fill(hu.begin(), hu.end(), air_hu);
    std::fill(tissue.begin(), tissue.end(), std::uint8_t{0});
    const double h = grid.spacing_mm;
    for (int y = 0; y < grid.size_voxels.y; ++y)
        for (int x = 0; x < grid.size_voxels.x; ++x) {
            const glm::dvec3 p = centre_of_voxel_mm(grid, {x, y, z});
            if (std::abs(p.y) > 7.7 || std::abs(p.x) > 23.2) continue;
            const Distances distances = distances_at(p);
            const double nearest = distances.nearest_mm();
            const auto index = static_cast<std::size_t>(x + grid.size_voxels.x * y);
            if (nearest >= h) {
                if (is_near_tooth(p) && jaw_mm(p) < 0.0) hu[index] = static_cast<std::int16_t>(ligament_hu);
                continue;
            }
            const Material material = distances.tooth_mm <= distances.socket_mm
                                          ? material_of_tooth(p, distances.tooth_mm)
                                          : material_of_jaw(p, jaw_mm(p), distances.tooth_mm);
            const double outside_hu = jaw_mm(p) < 0.0 ? ligament_hu : air_hu;
            hu[index] =
                static_cast<std::int16_t>(std::lround(across_surface(material.hu, outside_hu, nearest / h)));
            tissue[index] = static_cast<std::uint8_t>(material.tissue);
        }
}

}  // namespace

HuSlices make_tooth_phantom() {
    const Grid grid{.size_voxels = {512, 512, 128}, .spacing_mm = 0.1, .origin_mm = {-25.55, -25.55, -8.45}};
    return {.grid = grid,
            .labelled = true,
            .read =
                [grid, z = 0](std::span<std::int16_t> hu, std::span<std::uint8_t> tissue) mutable {
                    const std::size_t slice = 512 * 512;
                    for (std::size_t at = 0; at < hu.size(); at += slice)
                        fill_slice(grid, z++, hu.subspan(at, slice), tissue.subspan(at, slice));
                },
            .surface_distance_voxels =
                [grid](const glm::ivec3& voxel) {
                    return surface_distance_mm(centre_of_voxel_mm(grid, voxel), grid.spacing_mm) /
                           grid.spacing_mm;
                }};
}

}  // namespace osteomill
