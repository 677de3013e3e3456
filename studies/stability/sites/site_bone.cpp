#include "studies/stability/sites/site_bone.h"

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
    const glm::ivec3 bricks = size_in_bricks(grid);
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x) {
                ByteBrick fraction{};
                ByteBrick stiffness{};
                for (int i = 0; i < brick_edge_voxels * brick_edge_voxels * brick_edge_voxels; ++i) {
                    const glm::ivec3 within(i % brick_edge_voxels, i / brick_edge_voxels % brick_edge_voxels,
                                            i / (brick_edge_voxels * brick_edge_voxels));
                    const glm::ivec3 voxel = glm::ivec3(x, y, z) * brick_edge_voxels + within;
                    if (!contains(grid, voxel)) continue;
                    const glm::dvec3 at_mm = grid.origin_mm + site_voxel_mm * glm::dvec3(voxel);
                    const std::size_t offset = offset_in_brick(voxel);
                    fraction[offset] = level(255.0 * (0.5 - shape.distance_mm(at_mm) / site_voxel_mm), 255.0);
                    if (is_heterogeneous)
                        stiffness[offset] =
                            level(shape.relative_stiffness(at_mm) / stiffness_per_code, 255.0);
                }
                builder.add_brick({x, y, z}, fraction, is_heterogeneous ? &stiffness : nullptr, nullptr);
            }
    return std::move(builder).build();
}

}  // namespace osteomill::study
