#include "simulation/device/arm_spring.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/simulated/hand_and_arm.h"
#include "simulation/coupling/coupling_spring.h"
#include "tests/support/bench/bench_run.h"

namespace osteomill::arm_spring_test {
namespace {

using ::testing::HasSubstr;

/// Growth of a push against a wall behind the coupling's spring, on an arm that nobody holds, so many ticks
/// late.
double growth_per_s(double mass_kg, const PatientLimits& arm, std::size_t delay_ticks) {
    constexpr double tick_s = 0.001;
    constexpr std::size_t ticks = 3000;
    CouplingSpring spring(arm, 0.01);
    spring.place(glm::dvec3(0.0));
    const testing::Bench bench{.body = {.mass_kg = mass_kg, .damping_n_s_per_m = 0.5},
                               .delay_ticks = delay_ticks};
    const auto law = [&](double position_m) {
        // A wall that holds the burr, pulled at or pushed: the spring alone is what may be unstable.
        spring.follow_hand(glm::dvec3(1000.0 * position_m, 0.0, 0.0), tick_s);
        return spring.follow_burr(glm::dvec3(0.0), tick_s).x;
    };
    return testing::growth_per_s(testing::run_bench(bench, law, testing::push, ticks, 0.1), tick_s, ticks);
}

TEST(ArmSpring, KnowsTheTableOfWalls) {
    const double b4[] = {6.2, 2.27, 1.35};  // coupling.md, bare arm
    const double b12[] = {10.98, 3.68, 1.81};
    for (int ticks = 0; ticks < 3; ++ticks) {
        EXPECT_NEAR(stiffest_wall_n_per_mm(0.045, 0.004, ticks), b4[ticks], 0.01) << ticks;
        EXPECT_NEAR(stiffest_wall_n_per_mm(0.045, 0.012, ticks), b12[ticks], 0.01) << ticks;
    }
    const double between = stiffest_wall_n_per_mm(0.045, 0.004, 1.5);
    EXPECT_LT(between, b4[1]);
    EXPECT_GT(between, b4[2]);
    EXPECT_EQ(stiffest_wall_n_per_mm(0.0, 0.004, 1.0), 0.0);
}

TEST(ArmSpring, HoldsAWallOnEveryArmWithAThirdToSpare) {
    for (const double mass_kg : {0.02, 0.045, 0.1, 0.3, 1.0})
        for (std::size_t ticks = 1; 0.001 * static_cast<double>(ticks) <= longest_delay_s; ++ticks) {
            const ArmSpring spring = stiffest_spring({.claimed_n_per_mm = 100.0,
                                                      .mass_kg = mass_kg,
                                                      .delay_s = 0.001 * static_cast<double>(ticks)});
            for (const double more : {1.0, 1.4}) {
                const PatientLimits arm{.max_stiffness_n_per_mm = more * spring.stiffness_n_per_mm,
                                        .damping_n_s_per_mm = spring.damping_n_s_per_mm};
                EXPECT_LT(growth_per_s(mass_kg, arm, ticks), 0.0) << mass_kg << " kg, late by " << ticks;
            }
        }
}

TEST(ArmSpring, SaysWhichLimitItMet) {
    const auto limited_by = [](const ArmFigures& arm) {
        return std::string(stiffest_spring(arm).limited_by);
    };
    EXPECT_THAT(limited_by({.claimed_n_per_mm = 1.0}), HasSubstr("claims"));
    EXPECT_THAT(limited_by({.claimed_n_per_mm = 14.5}), HasSubstr("delay"));
    EXPECT_THAT(limited_by({.claimed_n_per_mm = 14.5, .mass_kg = 0.3}), HasSubstr("touch"));
    EXPECT_THAT(limited_by({.position_resolution_mm = 0.1}), HasSubstr("encoders"));
    EXPECT_THAT(limited_by({.position_resolution_mm = 0.055, .friction_n = 0.02}), HasSubstr("friction"));
}

TEST(ArmSpring, OfTheSimulatedArmIsNearWhatItsMassAndStepsAllow) {
    const ArmModel arm;
    const DeviceLimits gets = limits_of(arm);
    EXPECT_EQ(gets.max_stiffness_n_per_mm, arm.max_stiffness_n_per_mm);
    EXPECT_EQ(gets.max_stiffness_n_per_mm, limits_of({.resolution_mm = 0.0}).max_stiffness_n_per_mm);
    const ArmSpring any = stiffest_spring(
        {.claimed_n_per_mm = 100.0, .position_resolution_mm = arm.resolution_mm, .friction_n = 0.26});
    EXPECT_LT(gets.max_stiffness_n_per_mm, any.stiffness_n_per_mm);
    EXPECT_GT(gets.max_stiffness_n_per_mm, 0.95 * any.stiffness_n_per_mm);
    const double felt_n =
        ArmSpring::share_of_step * arm.resolution_mm *
        (gets.max_stiffness_n_per_mm + gets.damping_n_s_per_mm / (ArmSpring::hand_filter_s + 0.001));
    EXPECT_LT(felt_n, 0.8 * ArmSpring::felt_step_n);
}

TEST(ArmSpring, IsStifferTheBetterTheArmAndNeverMoreThanItClaims) {
    const ArmSpring fine =
        stiffest_spring({.claimed_n_per_mm = 14.5, .mass_kg = 0.2, .position_resolution_mm = 0.01});
    EXPECT_GT(fine.stiffness_n_per_mm, 2.5);
    // A step of 0.1 mm: 0.03 N / 0.01 mm less 0.004 N s/mm / 2 ms.
    EXPECT_NEAR(stiffest_spring({.position_resolution_mm = 0.1}).stiffness_n_per_mm, 1.0, 1e-9);
    for (const double claimed : {0.3, 0.8, 1.5}) {
        const ArmSpring spring = stiffest_spring({.claimed_n_per_mm = claimed});
        EXPECT_EQ(spring.stiffness_n_per_mm, claimed);
        EXPECT_EQ(spring.damping_n_s_per_mm, 0.004);
    }
    EXPECT_GT(stiffest_spring({.position_resolution_mm = 10.0}).stiffness_n_per_mm, 0.0);
}

}  // namespace
}  // namespace osteomill::arm_spring_test
