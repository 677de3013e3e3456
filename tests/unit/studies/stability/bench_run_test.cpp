#include "studies/stability/bench_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptic_server/device/arm_model.h"
#include "studies/stability/sampled_force.h"

namespace osteomill::study::bench_run_test {
namespace {

constexpr double tick_s = 1e-3;
const ArmModel arm;

double largest_force_n(const std::vector<BenchTick>& run) {
    double largest = 0.0;
    for (const BenchTick& tick : run) largest = std::max(largest, std::abs(tick.force_n));
    return largest;
}

TEST(BenchRun, ReadsThePositionInStepsOfTheSensor) {
    const Bench bench{.body = bare_arm(0.0), .sensor_resolution_m = 5.5e-5};
    std::vector<double> readings_m;
    run_bench(
        bench,
        [&](double sensed_m) {
            readings_m.push_back(sensed_m);
            return 0.0;
        },
        {0.0, 0.02}, 10);
    for (std::size_t tick = 0; tick < 10; ++tick)  // 20 um a tick
        EXPECT_DOUBLE_EQ(readings_m[tick], 5.5e-5 * std::round(static_cast<double>(tick) * 20.0 / 55.0));
}

TEST(BenchRun, GivesNoMoreThanTheMotorsCan) {
    const Bench bench{.body = bare_arm(0.1), .max_force_n = arm.max_force_n};
    const auto run = run_bench(
        bench, [](double) { return -50.0; }, {}, 3);
    EXPECT_EQ(run.back().force_n, -arm.max_force_n);
}

TEST(BenchRun, DelaysAForceAsManyTicksAsTheHoldThatIsLateByThem) {
    const HeldBody body = arm_in_hand(Grip::light);
    for (const std::size_t ticks : {1, 3, 12}) {
        const auto in_line = run_bench({.body = body, .delay_ticks = ticks},
                                       SampledForce(wall(150.0), interpolated(10), tick_s), push, 300);
        const auto in_weights =
            run_bench({.body = body},
                      SampledForce(wall(150.0), late_by_ticks(interpolated(10), ticks), tick_s), push, 300);
        EXPECT_NEAR(in_line.back().state.position_m, in_weights.back().state.position_m, 1e-15);
    }
}

TEST(BenchRun, StopsWhenTheDeviceHasLeft) {
    const auto run = run_bench(
        {.body = bare_arm(0.0)}, [](double) { return 1.0; }, {}, 10'000, 0.5);
    EXPECT_LT(run.size(), 10'000u);
    EXPECT_GT(growth_per_s(run, tick_s, 10'000), 0.0);
}

TEST(GrowthPerS, IsTheDecayOfAFreeSwing) {
    const auto run = run_bench(
        {.body = arm_in_hand(Grip::light)}, [](double) { return 0.0; }, push, 1500);
    const double expected = -2.1 / (2.0 * 0.145);
    EXPECT_NEAR(growth_per_s(run, tick_s, 1500), expected, 0.01 * std::abs(expected));
}

TEST(CoulombFriction, HidesALimitCycleThatIsThereWithoutIt) {
    // A wall at the device's limit, far past the edge of a bare arm: 2 b / T is 200 N/m. The motors' limit
    // bounds the swing.
    const std::size_t ticks = 6000;
    const auto run = [&](double friction_n) {
        Bench bench{.body = bare_arm(0.1), .max_force_n = arm.max_force_n};
        bench.body.coulomb_friction_n = friction_n;
        return run_bench(bench, SampledForce(wall(1500.0), zero_order_hold(), tick_s), push, ticks);
    };
    const auto smooth = run(0.0);
    EXPECT_EQ(largest_force_n(smooth), arm.max_force_n);
    EXPECT_NEAR(growth_per_s(smooth, tick_s, ticks), 0.0, 0.01) << "a steady swing";
    const auto sticky = run(arm.coulomb_friction_n);
    EXPECT_EQ(sticky.back().state.velocity_m_per_s, 0.0);
    EXPECT_LT(largest_force_n(sticky), arm.coulomb_friction_n);
}

TEST(SensorSteps, MakeADamperBuzzHarderThanTheArmRubs) {
    // One step in a tick is 55 mm/s: 5 N s/m answer with 0.275 N to a motion at 6 mm/s that deserves 0.03 N.
    const double resolution_m = 1e-3 * arm.resolution_mm;
    const Bench bench{.body = {.mass_kg = 1000.0, .damping_n_s_per_m = 0.0},
                      .sensor_resolution_m = resolution_m};
    const auto run =
        run_bench(bench, SampledForce(damper(5.0), zero_order_hold(), tick_s), {0.0, 0.006}, 100);
    EXPECT_NEAR(largest_force_n(run), 5.0 * resolution_m / tick_s, 1e-12);
    EXPECT_GT(largest_force_n(run), arm.coulomb_friction_n);
}

}  // namespace
}  // namespace osteomill::study::bench_run_test
