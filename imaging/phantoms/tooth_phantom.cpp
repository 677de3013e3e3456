#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "imaging/phantoms/anatomy_slices.h"
#include "imaging/phantoms/distance_fields.h"
#include "imaging/phantoms/noise.h"
#include "imaging/phantoms/phantom.h"
#include "imaging/phantoms/tooth_shape.h"

namespace osteomill {

namespace {

namespace df = distance_field;

constexpr double trabecular_hu = 450.0;
constexpr double trabecular_variation_hu = 120.0;

constexpr double cervix_z_mm = -1.6;  // where enamel ends
constexpr double ligament_mm = 0.2;
constexpr double cortical_mm = 1.8;

double occlusal_height_mm(double x, double y) {
    double height = 3.0;
    for (const double cusp_x : {-2.5, 2.5})
        for (const double cusp_y : {-2.2, 2.2}) {
            const double dx = x - cusp_x;
            const double dy = y - cusp_y;
            height += 1.0 * df::bump((dx * dx + dy * dy) / 9.0);
        }
    // Fissures: a groove along the row of teeth and one across.
    return height - 0.45 * df::bump(y * y / 0.49) - 0.3 * df::bump(x * x / 0.36);
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

struct Material {
    DentalTissue tissue;
    double hu;
};

Material material_of_tooth(const glm::dvec3& p, double tooth) {
    if (lesion_mm(p) < 0.0) return {DentalTissue::carious_lesion, lesion_hu};
    if (pulp_mm(p) < 0.0) return {DentalTissue::pulp, pulp_hu};
    const double enamel_thickness_mm = 1.7 * std::clamp((p.z - cervix_z_mm) / 3.0, 0.0, 1.0);
    if (-tooth < enamel_thickness_mm) return {DentalTissue::enamel, enamel_hu};
    return {DentalTissue::dentine, dentine_hu};
}

Material material_of_jaw(const glm::dvec3& p, double jaw, double tooth) {
    if (nerve_canal_mm(p) < 0.0) return {DentalTissue::nerve_canal, nerve_hu};
    // The socket is lined with cortical bone too (lamina dura), thinner than the shell.
    if (-jaw < cortical_mm || tooth < ligament_mm + 0.4) return {DentalTissue::cortical_bone, cortical_hu};
    return {DentalTissue::trabecular_bone, trabecular_hu + trabecular_variation_hu * linear_noise(p / 0.8)};
}

struct Distances {
    double tooth_mm;
    double socket_mm;  ///< of the jaw with the hole for the tooth
    double nearest_mm() const { return std::min(tooth_mm, socket_mm); }
};

bool is_near_tooth(const glm::dvec3& p) {
    return std::abs(p.x) < 7.0 && std::abs(p.y) < 6.5;
}

/// The bodies' own measures of distance, stretched by blending and slopes.
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
            hu[index] = static_cast<std::int16_t>(
                std::lround(hu_across_surface(material.hu, outside_hu, nearest / h)));
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
