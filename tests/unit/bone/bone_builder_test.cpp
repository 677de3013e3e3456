#include "common/bone/bone_builder.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill {
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

TEST(BoneBuilder, RefusesBadBricks) {
    auto builder = BoneBuilder::heterogeneous(odd_grid, 0.02, false);
    const ByteBrick stiffness = filled(50);
    EXPECT_THROW(builder.add_brick({2, 0, 0}, filled(1), &stiffness, nullptr), std::invalid_argument);
    EXPECT_THROW(builder.add_brick({0, 0, 0}, filled(1), nullptr, nullptr), std::invalid_argument);
    EXPECT_THROW(builder.add_brick({1, 0, 0}, filled(1), &stiffness, nullptr), std::invalid_argument)
        << "bone past the grid's edge";
    builder.add_brick({0, 0, 0}, filled(1), &stiffness, nullptr);
    EXPECT_THROW(builder.add_brick({0, 0, 0}, filled(1), &stiffness, nullptr), std::invalid_argument)
        << "twice";
    EXPECT_THROW(BoneBuilder::homogeneous(odd_grid, 0.0, false), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill
