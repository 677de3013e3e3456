#include "analysis/report/burr_in_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/bone/bone_ray.h"

namespace osteomill {

namespace {

constexpr double least_hiding_opacity = 0.5;

bool is_in_picture(const Viewpoint& view, const glm::dvec3& apart_mm) {
    const glm::dvec3 seen = glm::conjugate(view.rotation) * apart_mm;  // right, down, forward
    const double half_height = std::tan(0.5 * view.field_of_view_rad);
    return seen.z > 0.0 && std::abs(seen.y) <= half_height * seen.z &&
           std::abs(seen.x) <= taken_picture_width * half_height * seen.z;
}

}  // namespace

bool is_burr_in_view(const Bone& bone, const std::vector<Tissue>& tissues, const Viewpoint& view,
                     const glm::dvec3& burr_mm) {
    const glm::dvec3 apart_mm = burr_mm - view.eye_mm;
    const double distance_mm = glm::length(apart_mm);
    if (!(distance_mm > 0.0)) return true;
    if (!std::isfinite(distance_mm) || !is_in_picture(view, apart_mm)) return false;
    const Grid& grid = bone.grid();
    const BoneRay ray{to_voxel_coordinates(grid, view.eye_mm), apart_mm / distance_mm};
    RaySpan span = span_within(ray, grid);
    span = {std::max(0.0, span.from), std::min(distance_mm / grid.spacing_mm, span.to)};
    if (span.is_empty()) return true;
    const auto hides = [&](double t) {
        const std::uint8_t label = bone.tissue_at(glm::ivec3(glm::floor(ray.at(t) + 0.5)));
        const auto tissue = std::ranges::find(tissues, label, &Tissue::label);
        return tissue == tissues.end() || tissue->opacity >= least_hiding_opacity;
    };
    return !BoneSampler(bone).first_surface(ray, span, hides);
}

}  // namespace osteomill
