// A bone of random fractions, stiffness and tissue in some of its bricks, for tests: worst case for
// compression.
#pragma once

#include <algorithm>
#include <random>
#include <utility>

#include "common/bone/bone_builder.h"

namespace osteomill::testing {

struct SpeckledBoneOptions {
    Grid grid{.size_voxels = {70, 40, 33}, .spacing_mm = 0.2, .origin_mm = {1.5, -2.0, 30.25}};
    bool heterogeneous = true;
    bool labelled = true;
    double filled_bricks = 0.7;  ///< share of the bricks that hold bone
};

inline ByteBrick random_brick(std::mt19937& random, int lowest) {
    std::uniform_int_distribution<int> byte(lowest, 255);
    ByteBrick brick;
    std::generate(brick.begin(), brick.end(), [&] { return static_cast<std::uint8_t>(byte(random)); });
    return brick;
}

inline Bone make_speckled_bone(std::mt19937& random, const SpeckledBoneOptions& options = {}) {
    auto builder = options.heterogeneous ? BoneBuilder::heterogeneous(options.grid, 0.02, options.labelled)
                                         : BoneBuilder::homogeneous(options.grid, 1.25, options.labelled);
    const glm::ivec3 bricks = size_in_bricks(options.grid);
    std::bernoulli_distribution is_filled(options.filled_bricks);
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x) {
                if (!is_filled(random)) continue;
                ByteBrick fraction = random_brick(random, 1);
                for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
                    if (!contains(options.grid, 16 * glm::ivec3(x, y, z) + voxel_in_brick(voxel)))
                        fraction[voxel] = 0;
                const ByteBrick stiffness = random_brick(random, 0);
                const ByteBrick tissue = random_brick(random, 0);
                builder.add_brick({x, y, z}, fraction, &stiffness, &tissue);
            }
    return std::move(builder).build();
}

}  // namespace osteomill::testing
