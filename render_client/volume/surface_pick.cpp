#include "render_client/volume/surface_pick.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace osteomill {

namespace {

constexpr std::uint8_t surface_fraction = 128;
constexpr double step_voxels = 0.5;
/// The normal is that of the bone within so many voxels: a burr stands on more than one voxel.
constexpr int normal_reach_voxels = 6;

struct RaySpan {
    double from, to;
};

/// Where the ray is within the grid's box, in voxels along it.
std::optional<RaySpan> within_grid(const Grid& grid, const glm::dvec3& eye, const glm::dvec3& direction) {
    RaySpan span{0.0, std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const double low = -0.5 - eye[axis];
        const double high = grid.size_voxels[axis] - 0.5 - eye[axis];
        if (std::abs(direction[axis]) < 1e-12) {
            if (low > 0.0 || high < 0.0) return std::nullopt;
            continue;
        }
        const double a = low / direction[axis];
        const double b = high / direction[axis];
        span = {std::max(span.from, std::min(a, b)), std::min(span.to, std::max(a, b))};
    }
    return span.from < span.to ? std::optional(span) : std::nullopt;
}

/// From the middle of the bone round a voxel to the voxel: out of it.
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
    const glm::dvec3 direction = direction_through(camera, pixel, size_px);
    const glm::dvec3 eye = to_voxel_coordinates(grid, camera.eye_mm());
    const std::optional<RaySpan> span = within_grid(grid, eye, direction);
    if (!span) return std::nullopt;
    for (double at = span->from; at <= span->to; at += step_voxels) {
        const glm::dvec3 point = eye + at * direction;
        const glm::ivec3 voxel(glm::round(point));
        if (bone.fraction_at(voxel) < surface_fraction) continue;
        const glm::dvec3 position_mm = grid.origin_mm + grid.spacing_mm * point;
        const bool is_cut_away = std::ranges::any_of(
            cuts, [&](const CutPlane& cut) { return glm::dot(cut.normal, position_mm) > cut.offset_mm; });
        if (is_cut_away) continue;
        return SurfacePoint{position_mm, normal_at(bone, voxel, -direction)};
    }
    return std::nullopt;
}

}  // namespace osteomill
