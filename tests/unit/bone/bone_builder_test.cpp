#include "common/bone/bone_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace osteomill::bone_builder_test {
namespace {

const Grid odd_grid{.size_voxels = {20, 16, 40}, .spacing_mm = 0.1};

ByteBrick filled(std::uint8_t value) {
    ByteBrick brick;
    brick.fill(value);
    return brick;
}

TEST(BoneBuilder, OrdersSlotsWhateverTheOrderOfBricks) {
    auto builder = BoneBuilder::heterogeneous(odd_grid, 0.02, true);
    ByteBrick last = filled(0);
    last[0] = 30;
    const ByteBrick stiff_first = filled(1);
    const ByteBrick stiff_last = filled(2);
    builder.add_brick({1, 0, 2}, last, &stiff_last, &stiff_last);
    builder.add_brick({0, 0, 0}, filled(10), &stiff_first, &stiff_first);
    const Bone bone = std::move(builder).build();
    EXPECT_EQ(bone.content().brick_of_slot, (std::vector<BrickIndex>{0, 5}));
    EXPECT_EQ(bone.fraction_at({0, 0, 0}), 10);
    EXPECT_EQ(bone.fraction_at({16, 0, 32}), 30);
    EXPECT_DOUBLE_EQ(bone.stiffness_at({16, 0, 32}), 0.04);
    EXPECT_EQ(bone.tissue_at({0, 0, 0}), 1);
}

TEST(BoneBuilder, BuildsTheSameBoneInAnyOrderOfBricks) {
    const Grid grid{.size_voxels = {80, 64, 48}, .spacing_mm = 0.1};
    const glm::ivec3 bricks = size_in_bricks(grid);
    std::vector<BrickIndex> order(60);
    std::iota(order.begin(), order.end(), BrickIndex{0});
    const auto build = [&] {
        auto builder = BoneBuilder::heterogeneous(grid, 0.02, true);
        for (const BrickIndex brick : order) {
            const auto value = static_cast<std::uint8_t>(brick);
            const ByteBrick stiffness = filled(static_cast<std::uint8_t>(value + 60));
            const ByteBrick tissue = filled(static_cast<std::uint8_t>(value + 120));
            builder.add_brick(brick_position(bricks, brick), filled(value), &stiffness, &tissue);
        }
        return std::move(builder).build();
    };
    const Bone ascending = build();
    ASSERT_EQ(ascending.stored_bricks(), 59U) << "all but the first, whose fractions are 0";
    std::mt19937 random(5);
    for (int round = 0; round < 3; ++round) {
        std::shuffle(order.begin(), order.end(), random);
        const Bone shuffled = build();
        EXPECT_EQ(shuffled.content().brick_of_slot, ascending.content().brick_of_slot);
        EXPECT_EQ(shuffled.content().stiffness, ascending.content().stiffness);
        EXPECT_EQ(shuffled.content().tissue, ascending.content().tissue);
        EXPECT_EQ(checksum(shuffled), checksum(ascending));
    }
}

TEST(BoneBuilder, RefusesABrickThatCameTwice) {
    for (const glm::ivec3 between : {glm::ivec3(0, 0, 0), glm::ivec3(0, 0, 1)}) {
        auto builder = BoneBuilder::homogeneous(odd_grid, 1.0, false);
        for (const glm::ivec3& brick : {glm::ivec3(0, 0, 0), between, glm::ivec3(0, 0, 0)})
            builder.add_brick(brick, filled(1), nullptr, nullptr);
        EXPECT_THROW((void)std::move(builder).build(), std::invalid_argument);
    }
}

TEST(BoneBuilder, RefusesBadBricks) {
    auto builder = BoneBuilder::heterogeneous(odd_grid, 0.02, false);
    const ByteBrick stiffness = filled(50);
    EXPECT_THROW(builder.add_brick({2, 0, 0}, filled(1), &stiffness, nullptr), std::invalid_argument);
    EXPECT_THROW(builder.add_brick({0, 0, 0}, filled(1), nullptr, nullptr), std::invalid_argument);
    EXPECT_THROW(builder.add_brick({1, 0, 0}, filled(1), &stiffness, nullptr), std::invalid_argument)
        << "bone past the grid's edge";
    EXPECT_THROW(BoneBuilder::homogeneous(odd_grid, 0.0, false), std::invalid_argument);
}

TEST(BoneBuilder, BecomesHeterogeneousOnTheWay) {
    auto late = BoneBuilder::homogeneous(odd_grid, 7 * 0.02, false);
    auto early = BoneBuilder::heterogeneous(odd_grid, 0.02, false);
    ByteBrick half = filled(0);
    std::fill_n(half.begin(), 100, std::uint8_t{200});
    ByteBrick codes = filled(0);
    std::fill_n(codes.begin(), 100, std::uint8_t{7});
    const ByteBrick other = filled(9);
    late.add_brick({0, 0, 0}, half, nullptr, nullptr);
    late.make_heterogeneous(0.02, 7);
    late.add_brick({0, 0, 1}, filled(255), &other, nullptr);
    EXPECT_THROW(late.make_heterogeneous(0.02, 7), std::logic_error);
    early.add_brick({0, 0, 0}, half, &codes, nullptr);
    early.add_brick({0, 0, 1}, filled(255), &other, nullptr);
    const Bone bone = std::move(late).build();
    const Bone expected = std::move(early).build();
    EXPECT_EQ(bone.content().stiffness, expected.content().stiffness);
    EXPECT_EQ(bone.content().stiffness_per_code, expected.content().stiffness_per_code);
    EXPECT_EQ(checksum(bone), checksum(expected));
}

TEST(BrickPieces, ComeBackInTheirOrder) {
    BrickPieces pieces;
    constexpr std::size_t count = 40'000;  // more than a piece holds
    for (std::size_t i = 0; i < count; ++i) pieces.push_back(filled(static_cast<std::uint8_t>(i % 251)));
    const std::vector<ByteBrick> bricks = pieces.take();
    ASSERT_EQ(bricks.size(), count);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(bricks[i][4095], i % 251);
    EXPECT_TRUE(pieces.take().empty());
}

}  // namespace
}  // namespace osteomill::bone_builder_test
