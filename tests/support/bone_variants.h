// Bones that differ from a plain block in one thing.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/bone/bone_builder.h"
#include "common/scene/scene.h"

namespace osteomill::testing {

/// The same homogeneous bone of another relative stiffness.
inline Bone with_stiffness(const Bone& bone, double stiffness) {
    auto content = std::make_shared<BoneContent>(bone.content());
    content->homogeneous_stiffness = stiffness;
    std::vector<ByteBrick> fraction(bone.stored_bricks());
    for (std::size_t i = 0; i < fraction.size(); ++i)
        std::copy_n(bone.fractions(static_cast<std::int32_t>(i)).begin(), brick_voxel_count,
                    fraction[i].begin());
    return Bone(content, fraction);
}

/// Two bricks of 0.1 mm voxels, one above the other: tissue 1 on top, 2 below.
inline Bone bone_over_nerve() {
    const Grid grid{.size_voxels = {16, 16, 32}};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, true);
    ByteBrick full;
    full.fill(255);
    ByteBrick label;
    label.fill(1);
    builder.add_brick({0, 0, 1}, full, nullptr, &label);
    label.fill(2);
    builder.add_brick({0, 0, 0}, full, nullptr, &label);
    return std::move(builder).build();
}

/// Its tissues; the nerve is protected.
inline std::vector<Tissue> bone_and_nerve() {
    return {{.label = 1, .name = "bone"}, {.label = 2, .name = "nerve", .is_protected = true}};
}

}  // namespace osteomill::testing
