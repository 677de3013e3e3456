// Structures with answers in closed form: a ball, or whatever a rule says.
#pragma once

#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "common/bone/structure_mask.h"

namespace osteomill::testing {

/// Every voxel for whose centre, mm, `is_in` holds.
template <typename Rule>
StructureMask mask_where(const Grid& grid, Rule&& is_in) {
    const glm::ivec3 size = size_in_bricks(grid);
    std::vector<StructureBrick> bricks;
    for (BrickIndex brick = 0; brick < static_cast<BrickIndex>(size.x * size.y * size.z); ++brick) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, brick);
        VoxelMask voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            if (contains(grid, voxel) && is_in(centre_of_voxel_mm(grid, voxel))) voxels.set(offset);
        }
        bricks.push_back({brick, voxels});
    }
    return {grid, std::move(bricks)};
}

inline StructureMask ball_mask(const Grid& grid, const glm::dvec3& centre_mm, double radius_mm) {
    return mask_where(
        grid, [&](const glm::dvec3& place_mm) { return glm::distance(place_mm, centre_mm) <= radius_mm; });
}

}  // namespace osteomill::testing
