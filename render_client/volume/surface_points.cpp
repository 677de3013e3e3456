#include "render_client/volume/surface_points.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/bone/bone_ray.h"

namespace osteomill {

namespace {

/// The normal is that of the bone within so many voxels: a burr stands on more than one voxel.
constexpr int normal_reach_voxels = 6;

/// From the middle of the bone round a voxel to the voxel, which leads out of the bone.
glm::dvec3 normal_at(const Bone& bone, const glm::ivec3& voxel, const glm::dvec3& towards_eye) {
    glm::dvec3 sum(0.0);
    for (int z = -normal_reach_voxels; z <= normal_reach_voxels; ++z)
        for (int y = -normal_reach_voxels; y <= normal_reach_voxels; ++y)
            for (int x = -normal_reach_voxels; x <= normal_reach_voxels; ++x) {
                const glm::ivec3 offset(x, y, z);
                if (glm::dot(glm::dvec3(offset), glm::dvec3(offset)) >
                    normal_reach_voxels * normal_reach_voxels)
                    continue;
                sum -= static_cast<double>(bone.fraction_at(voxel + offset)) * glm::dvec3(offset);
            }
    return glm::length(sum) > 1e-9 ? glm::normalize(sum) : towards_eye;
}

}  // namespace

std::optional<SurfacePoint> pick_surface(const Bone& bone, const Camera& camera, const glm::dvec2& pixel,
                                         const glm::ivec2& size_px, std::span<const CutPlane> cuts) {
    const Grid& grid = bone.grid();
    const BoneRay ray{to_voxel_coordinates(grid, camera.eye_mm()), direction_through(camera, pixel, size_px)};
    RaySpan span = span_within(ray, grid);
    span.from = std::max(span.from, 0.0);
    const auto position_mm = [&](double t) { return grid.origin_mm + grid.spacing_mm * ray.at(t); };
    const auto is_shown = [&](double t) { return !is_cut_away(position_mm(t), cuts); };
    const auto met = BoneSampler(bone).first_surface(ray, span, is_shown);
    if (!met) return std::nullopt;
    return SurfacePoint{position_mm(*met),
                        normal_at(bone, glm::ivec3(glm::round(ray.at(*met))), -ray.direction)};
}

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

bool is_cut_away(const glm::dvec3& place_mm, std::span<const CutPlane> cuts) {
    return std::ranges::any_of(
        cuts, [&](const CutPlane& cut) { return glm::dot(cut.normal, place_mm) > cut.offset_mm; });
}

bool is_behind_bone(const Bone& bone, const glm::dvec3& eye_mm, const glm::dvec3& place_mm,
                    std::span<const CutPlane> cuts) {
    constexpr double own_surface_voxels = 3.0;
    const Grid& grid = bone.grid();
    const glm::dvec3 eye = to_voxel_coordinates(grid, eye_mm);
    const glm::dvec3 way = to_voxel_coordinates(grid, place_mm) - eye;
    const BoneRay ray{eye, glm::normalize(way)};
    RaySpan span = span_within(ray, grid);
    span.from = std::max(span.from, 0.0);
    span.to = std::min(span.to, glm::length(way) - own_surface_voxels);
    const auto is_shown = [&](double t) {
        return !is_cut_away(grid.origin_mm + grid.spacing_mm * ray.at(t), cuts);
    };
    return !span.is_empty() && BoneSampler(bone).first_surface(ray, span, is_shown);
}

}  // namespace osteomill
