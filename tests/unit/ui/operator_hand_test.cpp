#include "render_client/ui/input/operator_hand.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace osteomill::operator_hand_test {
namespace {

const glm::ivec2 size_px(800, 600);

ToolState tool_at(const glm::dvec3& position_mm) {
    ToolState tool;
    tool.burr_position_mm = position_mm;
    tool.hand_position_mm = position_mm;
    return tool;
}

TEST(OperatorHand, RestsOnTheToolUntilItIsTakenUp) {
    OperatorHand hand;
    hand.follow(tool_at({1.0, 2.0, 3.0}), 6);
    hand.follow(tool_at({2.0, 2.0, 3.0}), 6);
    EXPECT_EQ(hand.command().hand_target_mm, glm::dvec3(2.0, 2.0, 3.0));
    EXPECT_FALSE(hand.command().pedal);
}

TEST(OperatorHand, MovesTheTargetByThePixelsThatThePointerMoved) {
    OperatorHand hand;
    const Camera camera = camera_on({1.0, 2.0, 3.0}, 20.0);
    hand.follow(tool_at({1.0, 2.0, 3.0}), 6);
    const glm::dvec2 before = pixel_of(camera, hand.command().hand_target_mm, size_px);
    hand.move_in_picture({30.0, 12.0}, camera, size_px);
    const glm::dvec2 after = pixel_of(camera, hand.command().hand_target_mm, size_px);
    EXPECT_NEAR(glm::distance(after - before, glm::dvec2(30.0, 12.0)), 0.0, 1e-6);
}

TEST(OperatorHand, AdvancesTowardsTheTip) {
    OperatorHand hand;
    hand.follow(tool_at({0.0, 0.0, 5.0}), 6);
    hand.advance(0.5);
    EXPECT_EQ(hand.command().hand_target_mm, glm::dvec3(0.0, 0.0, 4.5));
}

TEST(OperatorHand, KeepsTheTargetWithinReachOfTheBurr) {
    OperatorHand hand;
    hand.follow(tool_at({0.0, 0.0, 5.0}), 6);
    hand.advance(100.0);
    hand.follow(tool_at({0.0, 0.0, 5.0}), 6);
    EXPECT_NEAR(glm::distance(hand.command().hand_target_mm, glm::dvec3(0.0, 0.0, 5.0)), longest_reach_mm,
                1e-9);
    hand.follow(tool_at({0.0, 0.0, 5.0}), 6, 3.0);
    EXPECT_NEAR(glm::distance(hand.command().hand_target_mm, glm::dvec3(0.0, 0.0, 5.0)), 3.0, 1e-9)
        << "two of the arm's millimetres are one of the patient's";
    ToolState held_back = tool_at({0.0, 0.0, 5.0});
    held_back.force_n = {0.0, 0.0, 1.0};
    hand.follow(held_back, 6);
    EXPECT_LE(glm::distance(hand.command().hand_target_mm, glm::dvec3(0.0, 0.0, 5.0)), 0.5 * longest_reach_mm)
        << "bone holds the burr back";
}

TEST(OperatorHand, PullsBackFromTheBurrHoweverFarItWasPushedAhead) {
    OperatorHand hand;
    const ToolState held_back = tool_at({1.0, 0.0, 5.0});
    hand.follow(held_back, 6);
    hand.advance(20.0);
    hand.follow(held_back, 6);
    hand.advance(-0.1);
    EXPECT_NEAR(hand.command().hand_target_mm.z, 5.1, 1e-9);
    hand.advance(-0.1);
    EXPECT_NEAR(hand.command().hand_target_mm.z, 5.2, 1e-9) << "from there it goes on as usual";
    EXPECT_NEAR(hand.command().hand_target_mm.x, 1.0, 1e-9);
}

TEST(OperatorHand, GoesClearOfTheBoneWhereTheForceGoesOff) {
    OperatorHand hand;
    ToolState tool = tool_at({0.0, 0.0, 5.0});
    hand.follow(tool, 6);
    hand.advance(6.0);
    hand.follow(tool, 6);
    // Without a wall it sinks to where it was pushed.
    for (const double z_mm : {4.0, 2.0, 1.0}) {
        tool = tool_at({0.0, 0.0, z_mm});
        tool.fault = "the milling model is late: force off";
        hand.advance(0.5);
        hand.follow(tool, 6);
        EXPECT_GT(hand.command().hand_target_mm.z, 5.5) << "above where the bone held it";
        EXPECT_LE(hand.command().hand_target_mm.z, 7.0);
    }
    hand.advance(-3.0);
    EXPECT_NEAR(hand.command().hand_target_mm.z, 9.0, 1e-9) << "farther out it may go";
    hand.follow(tool_at({0.0, 0.0, 9.0}), 6);
    hand.advance(0.5);
    EXPECT_NEAR(hand.command().hand_target_mm.z, 8.5, 1e-9) << "and in again once there is a force";
}

TEST(OperatorHand, LeavesAToolAloneThatNobodyHasTakenUpWhereTheForceGoesOff) {
    OperatorHand hand;
    ToolState tool = tool_at({0.0, 0.0, 5.0});
    hand.follow(tool, 6);
    tool.fault = "paused: force and spindle off";
    hand.follow(tool, 6);
    EXPECT_EQ(hand.command().hand_target_mm, tool.hand_position_mm);
}

TEST(OperatorHand, ChoosesOnlyBurrsThatThereAre) {
    OperatorHand hand;
    ToolState tool = tool_at({});
    tool.burr = 2;
    hand.follow(tool, 6);
    EXPECT_EQ(hand.command().burr, 2u);
    hand.choose_burr(8);
    hand.follow(tool, 6);
    EXPECT_EQ(hand.command().burr, 5u);
    hand.choose_burr(0);
    hand.choose_previous_burr();
    EXPECT_EQ(hand.command().burr, 0u);
}

TEST(OperatorHand, WantsTheToolOnceItIsUsedAndUntilItLetsGo) {
    for (const auto& use : std::vector<std::function<void(OperatorHand&)>>{
             [](OperatorHand& hand) { hand.advance(0.5); }, [](OperatorHand& hand) { hand.set_pedal(true); },
             [](OperatorHand& hand) { hand.choose_burr(1); }}) {
        OperatorHand hand;
        hand.follow(tool_at({}), 6);
        EXPECT_FALSE(hand.wants_tool());
        use(hand);
        EXPECT_TRUE(hand.wants_tool());
        hand.let_go();
        EXPECT_FALSE(hand.wants_tool());
    }
}

TEST(OperatorHand, LetsGoOfPedalAndTarget) {
    OperatorHand hand;
    hand.follow(tool_at({0.0, 0.0, 5.0}), 6);
    hand.set_pedal(true);
    hand.advance(1.0);
    hand.let_go();
    hand.follow(tool_at({0.0, 0.0, 5.0}), 6);
    EXPECT_FALSE(hand.command().pedal);
    EXPECT_EQ(hand.command().hand_target_mm, glm::dvec3(0.0, 0.0, 5.0));
}

/// Counts notches for the whole way, with the bone in sight.
int notches_for(double way_mm, double mm_per_px) {
    int notches = 0;
    for (double left_mm = way_mm; left_mm > 0.05 && notches < 1000; ++notches)
        left_mm -= wheel_step_mm(mm_per_px, left_mm);
    return notches;
}

TEST(WheelStep, IsFastInAirAndFineAtTheBone) {
    EXPECT_LE(notches_for(12.0, 0.05), 16) << "from where a mastoidectomy begins";
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.05, 0.0), 0.1);
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.05, std::nullopt), 2.5);
    EXPECT_GT(wheel_step_mm(0.05, 5.0), 10.0 * wheel_step_mm(0.05, 0.0));
}

TEST(WheelStep, FollowsTheZoomAtTheBone) {
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.02, 0.0), 0.04);
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.001, 0.0), 0.02);
    EXPECT_DOUBLE_EQ(wheel_step_mm(1.0, 0.0), 0.3);
}

TEST(WheelStep, FollowsTheZoomInAirToo) {
    for (const std::optional<double> ahead_mm : {std::optional<double>(), std::optional(12.0)}) {
        EXPECT_DOUBLE_EQ(wheel_step_mm(0.02, ahead_mm), 1.0);
        EXPECT_DOUBLE_EQ(wheel_step_mm(0.01, ahead_mm), 0.5) << "magnified twice as much: half of it";
        EXPECT_DOUBLE_EQ(wheel_step_mm(1.0, ahead_mm), 3.0) << "half of the hand's greatest lead";
    }
}

TEST(WheelStep, GoesThroughNoBone) {
    for (double ahead_mm = 0.0; ahead_mm < 30.0; ahead_mm += 0.01)
        EXPECT_LE(wheel_step_mm(0.05, ahead_mm), std::max(0.1, 0.3 * ahead_mm + 1e-12));
}

}  // namespace
}  // namespace osteomill::operator_hand_test
