// A cube of bone whose tissues follow a rule.
#pragma once

#include <cstdint>
#include <functional>

#include "common/bone/bone_builder.h"

namespace osteomill::testing {

/// A cube of solid bone about the origin; `tissue_at` gives each voxel's label by its centre.
inline Bone labelled_cube(int bricks_per_edge, double spacing_mm,
                          const std::function<std::uint8_t(const glm::dvec3&)>& tissue_at) {
    const int edge = brick_edge_voxels * bricks_per_edge;
    const Grid grid{.size_voxels = glm::ivec3(edge),
                    .spacing_mm = spacing_mm,
                    .origin_mm = glm::dvec3(-0.5 * spacing_mm * (edge - 1))};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, true);
    ByteBrick full;
    full.fill(255);
    for (int z = 0; z < bricks_per_edge; ++z)
        for (int y = 0; y < bricks_per_edge; ++y)
            for (int x = 0; x < bricks_per_edge; ++x) {
                ByteBrick tissue;
                for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
                    tissue[offset] = tissue_at(centre_of_voxel_mm(
                        grid, brick_edge_voxels * glm::ivec3(x, y, z) + voxel_in_brick(offset)));
                builder.add_brick({x, y, z}, full, nullptr, &tissue);
            }
    return std::move(builder).build();
}

}  // namespace osteomill::testing
