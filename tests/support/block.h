// A homogeneous block of bone for tests: fills every voxel whose centre lies in a box.
#pragma once

#include "common/bone/bone_builder.h"

namespace osteomill::testing {

/// A grid that holds the box [low, high] (patient LPS, mm), every voxel of the grid filled.
inline Bone make_block(const glm::dvec3& low_mm, const glm::dvec3& high_mm, double spacing_mm) {
    const glm::dvec3 cells = (high_mm - low_mm) / spacing_mm + 0.5;
    const Grid grid{
        .size_voxels = glm::ivec3(cells), .spacing_mm = spacing_mm, .origin_mm = low_mm + 0.5 * spacing_mm};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, false);
    const glm::ivec3 bricks = size_in_bricks(grid);
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x) {
                ByteBrick fraction{};
                for (int k = 0; k < 16; ++k)
                    for (int j = 0; j < 16; ++j)
                        for (int i = 0; i < 16; ++i) {
                            const glm::ivec3 voxel(16 * x + i, 16 * y + j, 16 * z + k);
                            if (contains(grid, voxel)) fraction[offset_in_brick(voxel)] = 255;
                        }
                builder.add_brick({x, y, z}, fraction, nullptr, nullptr);
            }
    return std::move(builder).build();
}

}  // namespace osteomill::testing
