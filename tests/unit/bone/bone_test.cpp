#include "common/bone/bone.h"

#include <gtest/gtest.h>

#include "common/bone/bone_builder.h"

namespace osteomill::bone_test {
namespace {

ByteBrick filled(std::uint8_t value) {
    ByteBrick brick;
    brick.fill(value);
    return brick;
}

const Grid grid_of_two_bricks{.size_voxels = {32, 16, 16}, .spacing_mm = 0.5};

TEST(Bone, StoresNothingForABrickWithoutBone) {
    auto builder = BoneBuilder::homogeneous(grid_of_two_bricks, 1.0, false);
    builder.add_brick({0, 0, 0}, filled(0), nullptr, nullptr);
    builder.add_brick({1, 0, 0}, filled(255), nullptr, nullptr);
    const Bone bone = std::move(builder).build();

    EXPECT_EQ(bone.stored_bricks(), 1U);
    EXPECT_EQ(bone.fraction_at({15, 0, 0}), 0);
    EXPECT_EQ(bone.fraction_at({16, 0, 0}), 255);
    EXPECT_EQ(bone.fraction_at({32, 0, 0}), 0) << "outside the grid";
    EXPECT_EQ(bone.fraction_at({-1, 0, 0}), 0) << "outside the grid";
    EXPECT_EQ(bone.stiffness_at({15, 0, 0}), 0.0);
    EXPECT_EQ(bone.stiffness_at({16, 0, 0}), 1.0);
    EXPECT_LT(memory_bytes(bone), 4096U + 64U) << "one brick of fractions and its table, no stiffness";
}

TEST(Bone, CopiesShareWhatTheCtGave) {
    auto builder = BoneBuilder::heterogeneous(grid_of_two_bricks, 0.02, false);
    const ByteBrick stiffness = filled(50);
    builder.add_brick({0, 0, 0}, filled(255), &stiffness, nullptr);
    Bone bone = std::move(builder).build();
    Bone mirror = bone;
    bone.fractions(0)[0] = 7;
    EXPECT_EQ(mirror.fractions(0)[0], 255);
    EXPECT_EQ(&mirror.content(), &bone.content());
    EXPECT_DOUBLE_EQ(bone.stiffness_at({0, 0, 0}), 1.0);
}

TEST(Bone, VolumeCountsPartialVoxelsAndTissues) {
    auto builder = BoneBuilder::homogeneous(grid_of_two_bricks, 1.0, true);
    ByteBrick tissue = filled(3);
    tissue[0] = 9;
    ByteBrick fraction = filled(0);
    fraction[0] = 51;
    fraction[1] = 255;
    builder.add_brick({0, 0, 0}, fraction, nullptr, &tissue);
    const Bone bone = std::move(builder).build();
    EXPECT_DOUBLE_EQ(bone_volume_mm3(bone), 0.125 * 1.2);
    const auto by_tissue = bone_volume_by_tissue_mm3(bone);
    EXPECT_DOUBLE_EQ(by_tissue[9], 0.125 * 0.2);
    EXPECT_DOUBLE_EQ(by_tissue[3], 0.125);
    EXPECT_EQ(bone.tissue_at({0, 0, 0}), 9);
}

TEST(Bone, ChecksumSeesEveryVoxelAndNoEmptyBrick) {
    auto build = [](std::uint8_t second) {
        auto builder = BoneBuilder::homogeneous(grid_of_two_bricks, 1.0, false);
        builder.add_brick({0, 0, 0}, filled(200), nullptr, nullptr);
        builder.add_brick({1, 0, 0}, filled(second), nullptr, nullptr);
        return std::move(builder).build();
    };
    Bone carved = build(255);
    const std::uint64_t before = checksum(carved);
    carved.fractions(1)[4095] = 254;
    EXPECT_NE(checksum(carved), before);
    for (auto& f : carved.fractions(1)) f = 0;
    EXPECT_EQ(checksum(carved), checksum(build(0))) << "a brick milled away counts like one never stored";
}

TEST(Bone, ChecksumTellsPlacesApart) {
    auto build = [](int place) {
        auto builder = BoneBuilder::homogeneous(grid_of_two_bricks, 1.0, false);
        builder.add_brick({place, 0, 0}, filled(200), nullptr, nullptr);
        return std::move(builder).build();
    };
    EXPECT_NE(checksum(build(0)), checksum(build(1)));
}

TEST(Bone, TakesNoMoreMemoryInALargerGrid) {
    const auto bytes = [](const glm::ivec3& size_voxels) {
        auto builder = BoneBuilder::heterogeneous(Grid{.size_voxels = size_voxels}, 0.02, true);
        const ByteBrick some = filled(100);
        for (int i = 0; i < 4; ++i) builder.add_brick({i, 1, i}, filled(255), &some, &some);
        return memory_bytes(std::move(builder).build());
    };
    const std::size_t small = bytes({64, 64, 64});
    EXPECT_GE(small, 4 * 3 * sizeof(ByteBrick));
    EXPECT_LE(small, 4 * (3 * sizeof(ByteBrick) + 64));
    EXPECT_EQ(bytes({256, 128, 128}), small);
    EXPECT_EQ(bytes({65536, 65536, 4096}), small);
}

TEST(Bone, RefusesChannelsThatDoNotAgree) {
    auto content = std::make_shared<BoneContent>();
    content->grid = grid_of_two_bricks;
    content->size_bricks = size_in_bricks(content->grid);
    content->brick_of_slot = {0};
    content->slot_of_brick = BrickTable(content->brick_of_slot);
    EXPECT_THROW(Bone(content, {}), std::invalid_argument);
    content->brick_of_slot = {1};
    EXPECT_THROW(Bone(content, std::vector<ByteBrick>(1)), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::bone_test
