#include "simulation/device/measured_arm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "devices/simulated/hand_and_arm.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

DeviceLimits claiming(double n_per_mm) {
    return with_stiffest_spring({.max_stiffness_n_per_mm = n_per_mm, .apparent_mass_kg = 0.3}, 0.001);
}

TEST(MeasuredSpring, GoesBeyondAClaimWhereItWasCalm) {
    const DeviceLimits stated = claiming(1.0);
    EXPECT_EQ(stated.max_stiffness_n_per_mm, 1.0);
    MeasuredArm measured{.calm_n_per_mm = 2.4, .damping_n_s_per_mm = 0.004};
    const DeviceLimits gets = with_measured_spring(stated, 0.001, measured);
    EXPECT_NEAR(gets.max_stiffness_n_per_mm, 1.6, 1e-9);
    EXPECT_EQ(gets.damping_n_s_per_mm, 0.004);
    EXPECT_THAT(gets.stiffness_is_limited_by, HasSubstr("measured"));
    measured.calm_n_per_mm = 0.9;
    EXPECT_NEAR(with_measured_spring(stated, 0.001, measured).max_stiffness_n_per_mm, 0.6, 1e-9)
        << "and below it where it was not";
}

TEST(MeasuredSpring, KeepsTheOtherLimits) {
    const MeasuredArm calm_on_all{.calm_n_per_mm = 100.0, .damping_n_s_per_mm = 0.004};
    // A touch at 40 mm/s, as arm_spring.h has it.
    const MeasuredArm damped{.calm_n_per_mm = 100.0, .damping_n_s_per_mm = 0.008};
    EXPECT_THAT(with_measured_spring(claiming(1.0), 0.001, damped).stiffness_is_limited_by,
                HasSubstr("touch"));
    // The arm alone: a hand lets go.
    DeviceLimits light = claiming(1.0);
    light.apparent_mass_kg = 0.045;
    MeasuredArm in_hand = calm_on_all;
    in_hand.moving_mass_kg = 0.545;
    EXPECT_NEAR(with_measured_spring(light, 0.001, in_hand).max_stiffness_n_per_mm,
                2.0 / 3.0 * stiffest_wall_n_per_mm(0.045, 0.004, 1.0), 1e-9);
    in_hand.moving_mass_kg = 0.03;
    EXPECT_NEAR(with_measured_spring(light, 0.001, in_hand).max_stiffness_n_per_mm,
                2.0 / 3.0 * stiffest_wall_n_per_mm(0.03, 0.004, 1.0), 1e-9);
    // The longer delay of the two.
    MeasuredArm late = calm_on_all;
    late.delay_s = 0.002;
    const double two_late = with_measured_spring(light, 0.001, late).max_stiffness_n_per_mm;
    EXPECT_NEAR(two_late, 2.0 / 3.0 * stiffest_wall_n_per_mm(0.045, 0.004, 2.0), 1e-9);
    late.delay_s = 0.0;
    EXPECT_EQ(with_measured_spring(light, 0.002, late).max_stiffness_n_per_mm, two_late);
}

TEST(MeasuredSpring, KeepsAStepBelow30MillinewtonsAsItWasMeasured) {
    for (const double damping : {0.001, 0.002, 0.004}) {
        for (const double noise_mm : {0.0, 0.05}) {
            const MeasuredArm coarse{
                .calm_n_per_mm = 100.0, .damping_n_s_per_mm = damping, .step_mm = 0.07, .noise_mm = noise_mm};
            const DeviceLimits gets = with_measured_spring(claiming(1.0), 0.001, coarse);
            EXPECT_NEAR(gets.position_resolution_mm,
                        noise_mm > 0.0 ? 4.0 * std::sqrt(0.05 * 0.05 - 0.035 * 0.035) : 0.07, 1e-12);
            const double felt_n =
                ArmSpring::share_of_step * gets.position_resolution_mm *
                (gets.max_stiffness_n_per_mm + damping / (ArmSpring::hand_filter_s + 0.001));
            EXPECT_LE(felt_n, ArmSpring::felt_step_n + 1e-9);
        }
    }
}

TEST(MeasuredSpring, HopesForMoreThanTheSimulatedArmClaims) {
    const DeviceLimits simulated = limits_of(ArmModel{});
    const MeasuredArm measured{.step_mm = 0.055, .delay_s = 0.0, .moving_mass_kg = 0.145, .friction_n = 0.26};
    const ArmSpring hoped = hoped_spring(simulated, 0.0, measured);
    EXPECT_GT(hoped.stiffness_n_per_mm, 1.15 * simulated.max_stiffness_n_per_mm);
    // The wall of a bare arm one tick late still has a third to spare.
    EXPECT_LE(hoped.stiffness_n_per_mm,
              2.0 / 3.0 * stiffest_wall_n_per_mm(0.045, hoped.damping_n_s_per_mm, 1.0) + 1e-9);
}

}  // namespace
}  // namespace osteomill
