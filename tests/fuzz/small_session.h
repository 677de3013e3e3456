// A session small enough to be fuzzed thousands of times a second: three bricks of bone, the last of them cut
// by the edge of the grid, and a grid that also has bricks that are not stored.
#pragma once

#include "common/bone/bone_builder.h"
#include "common/wire/scene_messages.h"
#include "common/wire/session_info.h"

namespace osteomill::fuzz {

inline SessionInfo small_session_info() {
    return {.scene_name = "small",
            .server_version = "0.0.fuzz",
            .burrs = {Burr{.name = "round 1.5", .diameter_mm = 1.5}, Burr{.name = "round 5"}},
            .tissues = {Tissue{.label = 2, .name = "nerve", .is_protected = true}},
            .accepts_operator = true,
            .force_limit_n = 3.3};
}

inline Bone small_bone() {
    const Grid grid{.size_voxels = {36, 20, 16}, .spacing_mm = 0.1, .origin_mm = {0.0, 0.0, 0.0}};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, false);
    for (const glm::ivec3 brick : {glm::ivec3(0, 0, 0), glm::ivec3(1, 0, 0), glm::ivec3(2, 1, 0)}) {
        ByteBrick fraction{};
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            if (contains(grid, brick_edge_voxels * brick + voxel_in_brick(voxel))) fraction[voxel] = 200;
        builder.add_brick(brick, fraction, nullptr, nullptr);
    }
    return std::move(builder).build();
}

}  // namespace osteomill::fuzz
