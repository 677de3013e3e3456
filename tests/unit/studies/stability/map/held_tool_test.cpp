#include "studies/stability/map/held_tool.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill::study::held_tool_test {
namespace {

constexpr double substep_s = 1e-5;

TEST(HeldTool, OfABareArmApproachesItsFinalSpeedUnderAForce) {
    const HeldTool tool = held_tool(MapGrip::bare_arm);
    ToolMotion motion;
    for (int i = 0; i < 5000; ++i)
        motion = fine_step(tool, {}, motion, i * substep_s, {0.0, 1.0, 0.0}, substep_s);
    const double final_mm_per_s = 1.0 / 0.0005;
    const double time_constant_s = 0.045 / 0.5;
    const double share = 1.0 - std::exp(-0.05 / time_constant_s);
    EXPECT_NEAR(motion.velocity_mm_per_s.y, final_mm_per_s * share, 1e-5 * final_mm_per_s);
    EXPECT_NEAR(motion.position_mm.y, final_mm_per_s * (0.05 - time_constant_s * share), 1e-3);
}

TEST(HeldTool, GoesOnSteadilyWhereTheIntentHoldsTheResistance) {
    const glm::dvec3 resistance_n(-0.2, 1.4, 0.2);
    for (const MapGrip grip : {MapGrip::bare_arm, MapGrip::light, MapGrip::firm}) {
        const HeldTool tool = held_tool(grip);
        const ToolMotion start{{1.0, 2.0, 3.0}, {6.0, 0.0, 0.0}};
        const HandIntent intent = steady_intent(tool, start, resistance_n);
        ToolMotion motion = start;
        for (int i = 0; i < 2000; ++i)
            motion = fine_step(tool, intent, motion, i * substep_s, resistance_n, substep_s);
        EXPECT_LT(glm::distance(motion.velocity_mm_per_s, start.velocity_mm_per_s), 1e-6);
        EXPECT_LT(glm::distance(motion.position_mm, glm::dvec3(1.12, 2.0, 3.0)), 1e-6);
    }
}

TEST(HeldTool, HandNeitherGainsNorLosesEnergyWithoutDamping) {
    HeldTool tool = held_tool(MapGrip::light);
    tool.arm_damping_n_s_per_mm = tool.hand_damping_n_s_per_mm = 0.0;
    ToolMotion motion{{5.0, 0.0, 0.0}, glm::dvec3(0.0)};
    double farthest_mm = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        motion = fine_step(tool, {}, motion, i * substep_s, glm::dvec3(0.0), substep_s);
        if (i > 70'000) farthest_mm = std::max(farthest_mm, motion.position_mm.x);
    }
    EXPECT_NEAR(farthest_mm, 5.0, 1e-4);
}

TEST(HeldTool, RestsWhileTheForceIsBelowFriction) {
    HeldTool tool = held_tool(MapGrip::bare_arm);
    tool.coulomb_friction_n = 0.26;
    ToolMotion motion{glm::dvec3(0.0), {50.0, 0.0, 0.0}};
    for (int i = 0; i < 5000; ++i)
        motion = fine_step(tool, {}, motion, i * substep_s, {0.2, 0.0, 0.0}, substep_s);
    EXPECT_EQ(motion.velocity_mm_per_s, glm::dvec3(0.0));
    const double least_mm = 0.5 * 50.0 * 50.0 * 0.045 / (0.06 * 1000.0 + 0.025 * 1000.0);
    EXPECT_GT(motion.position_mm.x, least_mm);
    EXPECT_LT(motion.position_mm.x, 0.5 * 50.0 * 50.0 * 0.045 / (0.06 * 1000.0));
}

TEST(HeldTool, OpenStepAgreesWithTheFineStep) {
    const HeldTool tool = held_tool(MapGrip::firm);
    const HandIntent intent{.target_mm = {2.0, 1.0, 0.0}, .velocity_mm_per_s = {6.0, 0.0, 0.0}};
    const glm::dvec3 force_n(0.3, -0.2, 1.0);
    const ToolMotion start{glm::dvec3(0.0), {10.0, 0.0, -4.0}};
    const OpenStep step = open_step(tool, intent, start, 0.1, 1e-6);
    const glm::dvec3 open = (step.drive_n + force_n) / step.inertia_n_s_per_mm - start.velocity_mm_per_s;
    const glm::dvec3 fine =
        fine_step(tool, intent, start, 0.1, force_n, 1e-6).velocity_mm_per_s - start.velocity_mm_per_s;
    EXPECT_LT(glm::distance(open, fine), 1e-4 * glm::length(fine));
}

TEST(HeldTool, KeepsItsHeightOnAGuideWhateverPushes) {
    HeldTool tool = held_tool(MapGrip::bare_arm);
    tool.is_guided_in_height = true;
    const HandIntent intent{.push_n = {0.5, 0.0, -2.0}};
    const glm::dvec3 force_n(0.0, 0.1, 1.0);
    const ToolMotion fine = fine_step(tool, intent, {}, 0.0, force_n, 1e-5);
    EXPECT_EQ(fine.position_mm.z, 0.0);
    EXPECT_GT(fine.velocity_mm_per_s.x, 0.0);
    const OpenStep open = open_step(tool, intent, {}, 0.0, 1e-5);
    EXPECT_LT(std::abs((open.drive_n.z + force_n.z) / open.inertia_n_s_per_mm.z), 1e-5);
}

}  // namespace
}  // namespace osteomill::study::held_tool_test
