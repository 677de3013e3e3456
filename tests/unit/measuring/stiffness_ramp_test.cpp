#include "haptic_server/measuring/stiffness_ramp.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "simulation/coupling/coupling_spring.h"
#include "tests/support/bench/fine_arm.h"

namespace osteomill::testing {
namespace {

RampedArm knowing(const FineFigures& figures) {
    return {.resolution_mm = figures.step_mm,
            .noise_mm = figures.noise_mm,
            .moving_mass_kg = figures.held().mass_kg,
            .friction_n = figures.arm.coulomb_friction_n,
            .delay_ticks = figures.delay_ticks};
}

/// Ramps; `each_tick` may change the arm. Returns when the ramp was over, s.
template <typename EachTick>
double run(StiffnessRamp& ramp, FineArm& arm, EachTick&& each_tick) {
    double now_s = 0.0;
    for (int i = 0; !ramp.is_over() && now_s < 40.0; ++i) {
        now_s = 1e-3 * i;
        each_tick(now_s);
        arm.write(ramp.tick(arm.read(now_s), now_s));
    }
    EXPECT_TRUE(ramp.is_over());
    EXPECT_EQ(arm.last_written_n(), glm::dvec3(0.0)) << "from the very tick in which it ended";
    double most_n = 0.0;
    for (const glm::dvec3& force_n : arm.written_n()) most_n = std::max(most_n, glm::length(force_n));
    EXPECT_LE(most_n, MeasuringGuard::most_force_n + 1e-9);
    return now_s;
}

double ramp_of(const FineFigures& figures, double damping_n_s_per_mm = 0.004) {
    FineArm arm(figures, 11);
    RampedArm known = knowing(figures);
    known.damping_n_s_per_mm = damping_n_s_per_mm;
    StiffnessRamp ramp(known, MeasuringGuard(3.3));
    run(ramp, arm, [](double) {});
    EXPECT_TRUE(ramp.swinging_n_per_mm() > ramp.calm_n_per_mm() || ramp.end() == MeasuringEnd::done);
    return ramp.calm_n_per_mm();
}

/// A bare arm: nothing but itself.
FineFigures bare(double mass_kg, double delay_ticks) {
    return {.arm = {.mass_kg = mass_kg, .damping_n_s_per_m = 0.5},
            .hand_kg = 0.0,
            .hand_damping_n_s_per_m = 0.0,
            .hand_stiffness_n_per_m = 30.0,  // so that it stays somewhere
            .delay_ticks = delay_ticks};
}

TEST(StiffnessRamp, FindsTheStiffestStableWallOfTheory) {
    for (const double mass_kg : {0.045, 0.15, 0.4})
        for (const double ticks : {1.0, 2.0, 3.0}) {
            const double edge = stiffest_wall_n_per_mm(mass_kg, 0.004, ticks);
            if (edge > StiffnessRamp::stiffest_n_per_mm) continue;
            const double share = ramp_of(bare(mass_kg, ticks)) / edge;
            EXPECT_LT(share, 1.15) << mass_kg << " kg, " << ticks;
            // A heavy arm swings for long well before the edge, and that is not calm.
            EXPECT_GT(share, mass_kg > 0.2 ? 0.5 : 0.8) << mass_kg << " kg, " << ticks;
        }
    EXPECT_EQ(ramp_of(bare(0.3, 0.0)), StiffnessRamp::stiffest_n_per_mm) << "calm on all: theory has over 20";
}

TEST(StiffnessRamp, FindsMoreBesideAStrongerDamperAndLessTheLater) {
    EXPECT_GT(ramp_of(bare(0.1, 2.0), 0.008), 1.2 * ramp_of(bare(0.1, 2.0), 0.004));
    EXPECT_LT(ramp_of(bare(0.1, 2.5)), 0.85 * ramp_of(bare(0.1, 1.5)));
}

TEST(StiffnessRamp, IsNotTakenInByAHandThatShakes) {
    FineFigures figures{.hand_kg = 0.5,
                        .hand_damping_n_s_per_m = 5.0,
                        .hand_stiffness_n_per_m = 300.0,
                        .tremor_mm = 0.3,
                        .tremor_hz = 10.0};
    figures.arm.coulomb_friction_n = 0.1;
    const double shaken = ramp_of(figures);
    figures.tremor_mm = 0.0;
    EXPECT_GE(shaken, 0.6 * ramp_of(figures));
}

TEST(StiffnessRamp, EndsWithTheArmOrThePedal) {
    const auto ends = [](auto&& change) {
        FineArm arm({.delay_ticks = 1.0}, 11);
        StiffnessRamp ramp(knowing({.delay_ticks = 1.0}), MeasuringGuard(3.3));
        EXPECT_LT(run(ramp, arm,
                      [&](double now_s) {
                          if (now_s > 3.0) change(arm);
                      }),
                  3.1);
        return ramp.end();
    };
    EXPECT_EQ(ends([](FineArm& arm) { arm.pedal = false; }), MeasuringEnd::pedal_up);
    EXPECT_EQ(ends([](FineArm& arm) { arm.is_there = false; }), MeasuringEnd::arm_lost);
}

TEST(StiffnessRamp, EndsWhenTheHandPushesTheArmAway) {
    FineArm arm({}, 11);
    StiffnessRamp ramp(knowing({}), MeasuringGuard(3.3));
    run(ramp, arm, [&](double now_s) {
        if (now_s > 1.0) arm.push_n.x = 3.0 * std::min(1.0, 4.0 * (now_s - 1.0));
    });
    EXPECT_EQ(ramp.end(), MeasuringEnd::moved_away);
    EXPECT_EQ(ramp.swinging_n_per_mm(), 0.0);
}

TEST(StiffnessRamp, StaysBoundedOnAnArmThatTheHandLetsGoInMidRamp) {
    for (const double delay_ticks : {0.0, 1.0, 2.0, 3.0}) {
        const FineFigures figures{.hand_kg = 0.5,
                                  .hand_damping_n_s_per_m = 5.0,
                                  .hand_stiffness_n_per_m = 300.0,
                                  .delay_ticks = delay_ticks};
        FineArm arm(figures, 11);
        StiffnessRamp ramp(knowing(figures), MeasuringGuard(3.3));
        double farthest_mm = 0.0;
        const double over_s = run(ramp, arm, [&](double now_s) {
            arm.is_held = now_s < 6.0;  // the pedal stays down
            if (now_s >= 6.0) farthest_mm = std::max(farthest_mm, std::abs(arm.position_mm(0)));
        });
        EXPECT_LT(farthest_mm, 3.0) << delay_ticks;
        // The arm alone swings on a softer spring than the one in a hand, and the ramp is then over.
        if (delay_ticks >= 2.0) {
            EXPECT_LT(over_s, 6.6) << delay_ticks;
        }
    }
}

TEST(StiffnessRamp, PullsAsTheCouplingDoesOnABurrThatStands) {
    const RampedArm known{.damping_n_s_per_mm = 0.006, .moving_mass_kg = 0.0};
    StiffnessRamp ramp(known, MeasuringGuard(3.3));
    CouplingSpring coupling(
        {.max_stiffness_n_per_mm = StiffnessRamp::softest_n_per_mm, .damping_n_s_per_mm = 0.006}, 0.01);
    DeviceState arm;
    const auto tick = [&](int i) {
        arm.pedal.said_s = 1e-3 * i;
        return ramp.tick(arm, 1e-3 * i);
    };
    tick(0);
    arm.pedal.is_down = true;
    glm::dvec3 place_mm(0.0);
    coupling.place(place_mm);
    for (int i = 1; i < 200; ++i) {
        arm.position_mm = {0.3 * std::sin(0.2 * (i - 1)), 0.0, 0.0};
        const double share = measuring_tick_s / (StiffnessRamp::place_filter_s + measuring_tick_s);
        place_mm += share * (arm.position_mm - place_mm);
        coupling.follow_hand(arm.position_mm, 1e-3);
        const glm::dvec3 pull_n = coupling.follow_burr(place_mm, 1e-3);
        const glm::dvec3 force_n = tick(i);
        if (i < 40) continue;  // the tap, and a burr that moves a little
        EXPECT_NEAR(force_n.x, pull_n.x, 0.01) << i;
    }
}

}  // namespace
}  // namespace osteomill::testing
