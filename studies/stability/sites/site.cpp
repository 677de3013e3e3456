#include "studies/stability/sites/site.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "common/bone/bone_builder.h"

namespace osteomill::study {
namespace {

constexpr double stiffness_per_code = 0.01;

std::uint8_t level(double value, double highest) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, highest)));
}

}  // namespace

Bone site_bone(const SiteShape& shape) {
    const glm::dvec3 first = glm::floor(shape.low_mm / site_voxel_mm);
    const glm::dvec3 last = glm::ceil(shape.high_mm / site_voxel_mm);
    const Grid grid{.size_voxels = glm::ivec3(last - first),
                    .spacing_mm = site_voxel_mm,
                    .origin_mm = (first + 0.5) * site_voxel_mm};
    const bool is_heterogeneous = static_cast<bool>(shape.relative_stiffness);
    BoneBuilder builder = is_heterogeneous ? BoneBuilder::heterogeneous(grid, stiffness_per_code, false)
                                           : BoneBuilder::homogeneous(grid, 1.0, false);
    return filled(std::move(builder), grid, [&](const glm::ivec3& voxel) {
        const glm::dvec3 at_mm = grid.origin_mm + site_voxel_mm * glm::dvec3(voxel);
        VoxelValues values{.fraction =
                               level(255.0 * (0.5 - shape.distance_mm(at_mm) / site_voxel_mm), 255.0)};
        if (is_heterogeneous)
            values.stiffness = level(shape.relative_stiffness(at_mm) / stiffness_per_code, 255.0);
        return values;
    });
}

}  // namespace osteomill::study
