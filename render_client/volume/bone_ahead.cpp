#include "render_client/volume/bone_ahead.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/bone/bone_ray.h"

namespace osteomill {

std::optional<double> bone_ahead_mm(const Bone& bone, const ToolState& tool, double burr_radius_mm) {
    const Grid& grid = bone.grid();
    const BoneRay ray{to_voxel_coordinates(grid, tool.burr_position_mm), -tool.spindle_axis};
    RaySpan span = span_within(ray, grid);
    span.from = std::max(span.from, burr_radius_mm / grid.spacing_mm);
    span.to = std::min(span.to, farthest_ahead_mm / grid.spacing_mm);
    if (span.is_empty()) return std::nullopt;
    const auto met = BoneSampler(bone).first_surface(ray, span, [](double) { return true; });
    if (!met) return std::nullopt;
    return std::max(0.0, *met * grid.spacing_mm - burr_radius_mm);
}

bool is_behind_bone(const Bone& bone, const glm::dvec3& eye_mm, const glm::dvec3& place_mm) {
    constexpr double own_surface_voxels = 3.0;
    const Grid& grid = bone.grid();
    const glm::dvec3 eye = to_voxel_coordinates(grid, eye_mm);
    const glm::dvec3 way = to_voxel_coordinates(grid, place_mm) - eye;
    const BoneRay ray{eye, glm::normalize(way)};
    RaySpan span = span_within(ray, grid);
    span.from = std::max(span.from, 0.0);
    span.to = std::min(span.to, glm::length(way) - own_surface_voxels);
    return !span.is_empty() && BoneSampler(bone).first_surface(ray, span, [](double) { return true; });
}

}  // namespace osteomill
