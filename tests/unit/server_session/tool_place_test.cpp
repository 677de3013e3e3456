#include "haptic_server/session/tool_place.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/block.h"

namespace osteomill {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);
const std::vector<HullBall> two_mm{{0.0, 1.0}};

Bone block_of_bone() {
    return testing::make_block(glm::dvec3(-5.0), glm::dvec3(5.0), 0.1);
}

TEST(ToolPlace, IsWhereItIsWantedInTheAir) {
    const ToolPose wanted{{0.0, 0.0, 8.0}, up};
    EXPECT_EQ(std::get<ToolPose>(clear_place(block_of_bone(), two_mm, wanted)), wanted);
}

TEST(ToolPlace, IsDrawnBackAlongTheHandpieceUntilItIsClear) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.0, 1.0, 2.0));
    const ToolPose found = std::get<ToolPose>(clear_place(block_of_bone(), two_mm, {{0.0, 0.0, 4.0}, axis}));
    EXPECT_NEAR(found.position_mm.z, 5.0 + 1.0 + least_gap_mm, 0.2);
    EXPECT_LT(glm::length(glm::cross(found.position_mm - glm::dvec3(0.0, 0.0, 4.0), axis)), 1e-9);
    EXPECT_EQ(found.spindle_axis, axis);
}

TEST(ToolPlace, CountsTheShank) {
    const std::vector<HullBall> with_shank{{0.0, 1.0}, {8.0, 3.0}};
    // Beside the block the burr is free, but its handpiece is not.
    const ToolPose wanted{{6.8, 0.0, -5.0}, up};
    EXPECT_EQ(std::get<ToolPose>(clear_place(block_of_bone(), two_mm, wanted)), wanted);
    EXPECT_GT(std::get<ToolPose>(clear_place(block_of_bone(), with_shank, wanted)).position_mm.z, -5.0);
}

TEST(ToolPlace, SaysWhyTheToolCannotBeThere) {
    // The distance is that to the box of the bricks, which end a millimetre above the bone.
    EXPECT_EQ(std::get<std::string>(clear_place(block_of_bone(), two_mm, {{0.0, 0.0, 100.0}, up})),
              "that is 94 mm away from the bone; choose a place within 50 mm of it");
    const Bone large = testing::make_block(glm::dvec3(-15.0), glm::dvec3(15.0), 0.5);
    EXPECT_EQ(std::get<std::string>(clear_place(large, two_mm, {{0.0, 0.0, -10.0}, up})),
              "that is inside the bone, and so is all within 20 mm along the handpiece");
}

TEST(ToolPlace, IsLiftedOutOfBoneThatCameBackHoweverDeepButNotOutOfAir) {
    EXPECT_FALSE(lifted_out(block_of_bone(), two_mm, {{0.0, 0.0, 6.1}, up})) << "near, but clear";
    const Bone large = testing::make_block(glm::dvec3(-15.0), glm::dvec3(15.0), 0.5);
    const auto lifted = lifted_out(large, two_mm, {{0.0, 0.0, -10.0}, up});
    ASSERT_TRUE(lifted);
    // A voxel of half a millimetre counts once all of it lies in the ball; a step is a tenth.
    EXPECT_NEAR(lifted->position_mm.z, 15.0 + 1.0 + least_gap_mm, 0.5 + 0.1);
}

}  // namespace
}  // namespace osteomill
