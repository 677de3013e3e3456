#include "simulation/coupling/direct_coupling.h"

#include <gtest/gtest.h>

#include <memory>

namespace osteomill::direct_coupling_test {
namespace {

constexpr ToolPose pressed{{0.4, 2.0, 3.0}, {0.0, 0.0, 1.0}};

HandState hand_at(int tick, bool spindle_on) {
    return {.now_s = 0.001 * tick, .pose = pressed, .spindle_on = spindle_on};
}

/// A wall across x at 0.1 mm.
std::unique_ptr<MillingResult> wall() {
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->engagement.count = 1;
    result->engagement.burr_position_mm = {0.0, 2.0, 3.0};
    result->engagement.patches[0] = {.normal = {1.0, 0.0, 0.0}, .gap_mm = 0.1, .area_mm2 = 1e6};
    return result;
}

DirectCoupling hold(bool model_holds_wall = false) {
    return {ForceEstimate::newest,
            ForceShape::held,
            {.device = {.max_stiffness_n_per_mm = 2.0}, .model_holds_wall = model_holds_wall}};
}

TEST(DirectCoupling, RendersTheModelsForceWithTheBurrOnTheDevice) {
    DirectCoupling coupling = hold();
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->force_n = {1.0, -2.0, 0.5};
    const CouplingOutput output = coupling.tick(hand_at(0, true), *result);
    EXPECT_EQ(output.force_n, result->force_n);
    EXPECT_EQ(output.burr_pose.position_mm, pressed.position_mm);
}

TEST(DirectCoupling, SamplesTheWallWithTheModelButLetsNoBurrIntoIt) {
    DirectCoupling coupling = hold();
    auto result = wall();
    EXPECT_NEAR(coupling.tick(hand_at(0, false), *result).force_n.x, 2.0 * (0.1 - 0.4), 1e-6);
    HandState deeper = hand_at(1, false);
    deeper.pose.position_mm.x = 0.9;
    const CouplingOutput between = coupling.tick(deeper, *result);
    EXPECT_NEAR(between.force_n.x, 2.0 * (0.1 - 0.4), 1e-6) << "held until the next result";
    EXPECT_NEAR(between.burr_pose.position_mm.x, 0.1, 1e-6);
    result->step = 2;
    EXPECT_NEAR(coupling.tick(deeper, *result).force_n.x, 2.0 * (0.1 - 0.9), 1e-6);
}

TEST(DirectCoupling, LeavesTheWallToAModelThatHoldsIt) {
    DirectCoupling coupling = hold(true);
    auto result = wall();
    result->force_n = {-0.7, 0.0, 0.0};
    const CouplingOutput output = coupling.tick(hand_at(0, false), *result);
    EXPECT_EQ(output.force_n, result->force_n);
    EXPECT_EQ(output.burr_pose.position_mm, pressed.position_mm);
}

TEST(DirectCoupling, ForgetsForceAndWallOnReset) {
    DirectCoupling coupling = hold();
    (void)coupling.tick(hand_at(0, false), *wall());
    coupling.reset();
    const MillingResult none{};
    const CouplingOutput output = coupling.tick(hand_at(1, false), none);
    EXPECT_EQ(output.force_n, glm::dvec3(0.0));
    EXPECT_EQ(output.burr_pose.position_mm, pressed.position_mm);
}

}  // namespace
}  // namespace osteomill::direct_coupling_test
