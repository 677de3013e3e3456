#include "analysis/report/surface_normal.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/bone/bone_ray.h"

namespace osteomill {

std::optional<glm::dvec3> normal_about(const Bone& bone, const glm::dvec3& centre_mm, double radius_mm) {
    constexpr int directions = 256;
    constexpr double golden_angle = std::numbers::pi * (3.0 - 2.2360679774997896);
    constexpr double least_slope = 0.02;  // of the mean direction's length, 0.25 over a half space
    BoneSampler sampler(bone);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < directions; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / directions;
        const double across = std::sqrt(1.0 - z * z);
        const glm::dvec3 direction(across * std::cos(golden_angle * i), across * std::sin(golden_angle * i),
                                   z);
        const glm::dvec3 place = to_voxel_coordinates(bone.grid(), centre_mm + radius_mm * direction);
        sum -= sampler.between(place) / 255.0 * direction;
    }
    const double length = glm::length(sum);
    return length > least_slope * directions ? std::optional(sum / length) : std::nullopt;
}

}  // namespace osteomill
