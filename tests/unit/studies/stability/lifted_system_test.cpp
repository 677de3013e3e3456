#include "studies/stability/lifted_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/stability/bench_run.h"
#include "studies/stability/exact_motion.h"
#include "studies/stability/sampled_force.h"

namespace osteomill::study::lifted_system_test {
namespace {

constexpr double tick_s = 1e-3;

TEST(LiftedSystem, StepsAsTheForceDoesTickByTick) {
    const HeldBody body = arm_in_hand(Grip::light);
    const ModelForce model{.stiffness_n_per_m = 900.0, .damping_n_s_per_m = 3.0};
    for (const LinearHold& hold :
         {interpolated(10), late_sample_estimate_hold(4), late_by_ticks(interpolated(10), 13)}) {
        const Eigen::MatrixXd step = lifted_system(body, model, hold, tick_s);
        Eigen::VectorXd lifted = Eigen::VectorXd::Zero(step.rows());
        lifted(1) = 0.1;
        const ExactMotion tick = exact_motion(body, tick_s);
        SampledForce force(model, hold, tick_s);
        MotionState state{0.0, 0.1};
        for (int period = 0; period < 20; ++period) {
            for (std::size_t i = 0; i < hold.ticks_per_sample(); ++i)
                state = tick.after(state, force(state.position_m));
            lifted = step * lifted;
            EXPECT_NEAR(lifted(0), state.position_m, 1e-12);
            EXPECT_NEAR(lifted(1), state.velocity_m_per_s, 1e-10);
        }
    }
}

TEST(SpectralRadius, IsTheLargestMagnitudeOfAComplexPair) {
    Eigen::MatrixXd turning_and_shrinking(3, 3);
    turning_and_shrinking << 0.6, -0.8, 0.3, 0.8, 0.6, -2.0, 0.0, 0.0, -0.9;
    EXPECT_NEAR(spectral_radius(turning_and_shrinking), 1.0, 1e-14);
}

TEST(LiftedSystem, GrowsAtTheRateAtWhichTheBenchSwings) {
    const HeldBody body = bare_arm(0.1);
    const std::size_t ticks = 3000;
    const auto expect_same_growth = [&](const LinearHold& hold, double stiffness_n_per_m) {
        const ModelForce model = wall(stiffness_n_per_m);
        const double period_s = tick_s * static_cast<double>(hold.ticks_per_sample());
        const double expected =
            std::log(spectral_radius(lifted_system(body, model, hold, tick_s))) / period_s;
        const auto run = run_bench({.body = body}, SampledForce(model, hold, tick_s), push, ticks);
        EXPECT_GT(std::abs(expected), 0.1);
        EXPECT_NEAR(growth_per_s(run, tick_s, ticks), expected, 0.01 * std::abs(expected))
            << stiffness_n_per_m;
    };
    // Past the edge, which lies at 200, 67, 4200 and 10.6 N/m, and below it.
    expect_same_growth(zero_order_hold(), 300.0);
    expect_same_growth(zero_order_hold(), 150.0);
    expect_same_growth(one_sample_late(), 100.0);
    expect_same_growth(sample_estimate_hold(), 5000.0);
    expect_same_growth(interpolated(10), 16.0);
    expect_same_growth(interpolated(10), 8.0);
}

TEST(IsStable, CallsABodyThatNothingHoldsUnstable) {
    EXPECT_FALSE(is_stable(bare_arm(0.1), wall(0.0), zero_order_hold(), tick_s));
    EXPECT_TRUE(is_stable(arm_in_hand(Grip::firm), wall(0.0), zero_order_hold(), tick_s));
}

}  // namespace
}  // namespace osteomill::study::lifted_system_test
