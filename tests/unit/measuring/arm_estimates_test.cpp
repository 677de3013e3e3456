#include "haptic_server/measuring/arm_estimates.h"

#include <gtest/gtest.h>

#include "haptic_server/measuring/arm_shake.h"
#include "tests/support/bench/fine_arm.h"

namespace osteomill::testing {
namespace {

/// Shakes an arm to the end.
ArmShake shaken(const FineFigures& figures) {
    FineArm arm(figures, 5);
    ArmShake shake(3.3);
    for (int i = 0; !shake.is_over(); ++i) arm.write(shake.tick(arm.read(1e-3 * i), 1e-3 * i));
    EXPECT_EQ(shake.end(), MeasuringEnd::done) << text_of(shake.end());
    return shake;
}

void expect_found(const FineFigures& figures, double mass_share, double friction_n, double delay_ticks) {
    const ArmShake shake = shaken(figures);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto found = pushed_motion(shake.push(k), k, figures.step_mm);
        ASSERT_TRUE(found) << k;
        EXPECT_NEAR(found->mass_kg / figures.held().mass_kg, 1.0, mass_share);
        EXPECT_NEAR(found->friction_n, figures.arm.coulomb_friction_n, friction_n);
        EXPECT_NEAR(found->delay_ticks, figures.delay_ticks, delay_ticks);
    }
}

TEST(PushedMotion, OfALinearArmIsExact) {
    expect_found({.delay_ticks = 0.0}, 0.005, 0.005, 0.11);
    expect_found({.delay_ticks = 1.7}, 0.005, 0.005, 0.11);
    expect_found(
        {.hand_kg = 0.5, .hand_damping_n_s_per_m = 5.0, .hand_stiffness_n_per_m = 300.0, .delay_ticks = 3.0},
        0.005, 0.005, 0.11);
}

TEST(PushedMotion, IsFoundThroughFrictionAndSteps) {
    FineFigures figures{.step_mm = 0.055, .delay_ticks = 1.0};
    figures.arm.coulomb_friction_n = 0.26;
    expect_found(figures, 0.05, 0.05, 0.3);
    figures.tremor_mm = 0.1;
    figures.noise_mm = 0.005;
    expect_found(figures, 0.08, 0.06, 0.4);
}

TEST(PushedMotion, OfAnArmThatDoesNotMoveIsNone) {
    FineFigures figures{.step_mm = 0.055};
    figures.arm.coulomb_friction_n = 5.0;  // more than it is ever pushed with
    const ArmShake shake = shaken(figures);
    EXPECT_FALSE(pushed_motion(shake.push(0), 0, 0.055));
    EXPECT_FALSE(pushed_motion({}, 0, 0.055));
}

TEST(PushedMotion, ThatIsNotOfThePushIsNone) {
    // A hand that moves by itself, while the arm pushes to and fro without any effect.
    std::vector<MeasuredTick> ticks(2000);
    for (std::size_t i = 0; i < ticks.size(); ++i)
        ticks[i] = {.position_mm = glm::dvec3(2.0 * std::sin(0.02 * static_cast<double>(i))),
                    .force_n = glm::dvec3(i / 17 % 2 == 0 ? 1.0 : -1.0)};
    EXPECT_FALSE(pushed_motion(ticks, 0, 0.0));
}

}  // namespace
}  // namespace osteomill::testing
