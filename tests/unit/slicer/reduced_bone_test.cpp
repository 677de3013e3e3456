#include "slicer/reduced_bone.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

TEST(ReducedBone, IsTheBoneItselfWhereItIsSmall) {
    std::mt19937 random(1);
    const Bone bone = testing::make_speckled_bone(random);
    const ReducedBone reduced(bone);
    ASSERT_EQ(reduced.voxels_a_voxel(), 1);
    EXPECT_EQ(reduced.grid(), bone.grid());
    std::size_t index = 0;
    for (int z = 0; z < bone.grid().size_voxels.z; ++z)
        for (int y = 0; y < bone.grid().size_voxels.y; ++y)
            for (int x = 0; x < bone.grid().size_voxels.x; ++x)
                ASSERT_EQ(reduced.values()[index++], bone.fraction_at({x, y, z}));
}

TEST(ReducedBone, HasTheMeanOfTheVoxelsThatOneStandsFor) {
    // 600 voxels long: three of them for one, and the last of 5 x 4 has less than three below it.
    const Grid grid{.size_voxels = {600, 5, 4}, .spacing_mm = 0.1, .origin_mm = {1.0, 2.0, 3.0}};
    const Bone bone = filled(BoneBuilder::homogeneous(grid, 1.0, false), grid, [](const glm::ivec3& voxel) {
        return VoxelValues{.fraction = static_cast<std::uint8_t>(voxel.x % 3 == 0 ? 240 : 30)};
    });
    const ReducedBone reduced(bone);
    EXPECT_EQ(reduced.voxels_a_voxel(), 3);
    EXPECT_EQ(reduced.grid().size_voxels, glm::ivec3(200, 2, 2));
    EXPECT_DOUBLE_EQ(reduced.grid().spacing_mm, 0.3);
    EXPECT_NEAR(reduced.grid().origin_mm.x, 1.1, 1e-12) << "the middle of the first three";
    EXPECT_EQ(reduced.values().front(), 100);
    // At the far edge in y and z two of three rows and one of three layers are left.
    EXPECT_EQ(reduced.values().back(), (100 * 2 * 1 + 4) / 9);
}

TEST(ReducedBone, FollowsTheBricksThatChange) {
    std::mt19937 random(2);
    Bone bone = testing::make_speckled_bone(random);
    ReducedBone reduced(bone);
    EXPECT_FALSE(reduced.update(bone, {}));
    const BrickIndex brick = bone.content().brick_of_slot.back();
    bone.fractions(bone.slot(brick))[5] = 0;
    const auto box = reduced.update(bone, std::vector{BrickChange{.brick = brick}});
    ASSERT_TRUE(box);
    EXPECT_EQ(box->first, brick_position(bone.content().size_bricks, brick) * brick_edge_voxels);
    const ReducedBone fresh(bone);
    EXPECT_TRUE(std::equal(reduced.values().begin(), reduced.values().end(), fresh.values().begin()));
}

}  // namespace
}  // namespace osteomill
