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

TEST(BrickChange, CorrectsACopyThatIsWrongButPutsNoBoneOutsideTheGrid) {
    Bone bone = half_stored_bone();
    ByteBrick whole;
    whole.fill(255);
    EXPECT_EQ(correct({0, VoxelMask().set(30)}, ByteBrick{}, bone), Correction::lowers);
    EXPECT_EQ(correct({0, VoxelMask().set_all()}, whole, bone), Correction::raises);
    EXPECT_EQ(bone.fractions(0)[30], 255);
    EXPECT_EQ(correct({1, VoxelMask().set(0)}, whole, bone), Correction::not_stored);

    auto builder = BoneBuilder::homogeneous(Grid{.size_voxels = {4, 16, 16}}, 1.0, false);
    ByteBrick one{};
    one[0] = 255;
    builder.add_brick({0, 0, 0}, one, nullptr, nullptr);
    Bone cut = std::move(builder).build();
    EXPECT_EQ(correct({0, VoxelMask().set_run(1, 4)}, whole, cut), Correction::outside_grid);
    EXPECT_EQ(cut.fractions(0)[1], 0) << "refused whole";
    EXPECT_FALSE(apply({0, VoxelMask().set(4), ChangeKind::restored}, whole, cut));
    EXPECT_EQ(correct({0, VoxelMask().set_run(1, 3)}, whole, cut), Correction::raises);
}

}  // namespace
}  // namespace osteomill::brick_change_test
