#include <gtest/gtest.h>

#include "common/bone/bone_builder.h"
#include "common/bone/structure_mask.h"

namespace osteomill {
namespace {

TEST(StructureInBone, IsWhereTheBoneBearsTheLabelWhateverIsLeft) {
    const Grid grid{.size_voxels = {32, 16, 16}, .spacing_mm = 0.1, .origin_mm = {}};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, true);
    ByteBrick fraction, tissue{};
    fraction.fill(255);
    tissue[7] = 3;
    tissue[9] = 4;
    builder.add_brick({1, 0, 0}, fraction, nullptr, &tissue);
    Bone bone = std::move(builder).build();
    const StructureMask nerve = structure_in_bone(bone, 3);
    EXPECT_EQ(nerve.voxel_count(), 1u);
    EXPECT_TRUE(nerve.contains({16 + 7, 0, 0}));
    EXPECT_TRUE(brick_has_label(bone, 0, 3));
    EXPECT_FALSE(brick_has_label(bone, 0, 5));
    EXPECT_TRUE(structure_in_bone(bone, 5).empty());

    bone.fractions(0)[7] = 0;
    EXPECT_TRUE(structure_in_bone(bone, 3) == nerve) << "milled, it is still where it was";
    EXPECT_FALSE(brick_has_label(bone, 0, 3));
    EXPECT_TRUE(brick_has_label(bone, 0, 4));
}

TEST(StructureInBone, IsNowhereInABoneWithoutLabels) {
    const Grid grid{.size_voxels = {16, 16, 16}, .spacing_mm = 0.1, .origin_mm = {}};
    auto builder = BoneBuilder::homogeneous(grid, 1.0, false);
    ByteBrick fraction;
    fraction.fill(255);
    builder.add_brick({0, 0, 0}, fraction, nullptr, nullptr);
    const Bone bone = std::move(builder).build();
    EXPECT_TRUE(structure_in_bone(bone, 0).empty());
}

}  // namespace
}  // namespace osteomill
