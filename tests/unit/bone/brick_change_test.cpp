#include "common/bone/brick_change.h"

#include <gtest/gtest.h>

#include "common/bone/bone_builder.h"

namespace osteomill::brick_change_test {
namespace {

Bone half_stored_bone() {
    auto builder = BoneBuilder::homogeneous(Grid{.size_voxels = {32, 16, 16}}, 1.0, false);
    ByteBrick fraction;
    fraction.fill(100);
    builder.add_brick({0, 0, 0}, fraction, nullptr, nullptr);
    return std::move(builder).build();
}

TEST(BrickChange, GivesItsVoxelsTheirFractionsAndNoOthers) {
    Bone bone = half_stored_bone();
    ByteBrick left{};
    left[30] = 5;
    left[4095] = 6;
    EXPECT_TRUE(apply({0, VoxelMask().set(30).set(4095)}, left, bone));
    EXPECT_EQ(bone.fractions(0)[29], 100);
    EXPECT_EQ(bone.fractions(0)[30], 5);
    EXPECT_EQ(bone.fractions(0)[31], 100);
    EXPECT_EQ(bone.fractions(0)[4095], 6);
}

TEST(BrickChange, AppliedTwiceChangesNothingMore) {
    Bone bone = half_stored_bone();
    const BrickChange change{0, VoxelMask().set_run(0, 16)};
    EXPECT_TRUE(apply(change, ByteBrick{1, 2, 3}, bone));
    const std::uint64_t once = checksum(bone);
    EXPECT_TRUE(apply(change, ByteBrick{1, 2, 3}, bone));
    EXPECT_EQ(checksum(bone), once);
}

TEST(BrickChange, IsRefusedWholeWhereItDoesNotFit) {
    Bone bone = half_stored_bone();
    const std::uint64_t before = checksum(bone);
    EXPECT_FALSE(apply({1, VoxelMask().set(0)}, ByteBrick{}, bone)) << "a brick without bone";
    EXPECT_FALSE(apply({2, VoxelMask().set(0)}, ByteBrick{}, bone)) << "a brick outside the grid";
    ByteBrick raised{};
    raised[4000] = 101;
    EXPECT_FALSE(apply({0, VoxelMask().set(0).set(4000)}, raised, bone));
    EXPECT_EQ(checksum(bone), before);
}

}  // namespace
}  // namespace osteomill::brick_change_test
