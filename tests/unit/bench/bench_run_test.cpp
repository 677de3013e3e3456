#include "tests/support/bench/bench_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "devices/simulated/hand_and_arm.h"

namespace osteomill::testing::bench_run_test {
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

TEST(BenchRun, DelaysAForceByItsTicks) {
    for (const std::size_t delay : {1, 3, 12}) {
        int asked = 0;
        const auto run = run_bench(
            {.body = bare_arm(0.0), .delay_ticks = delay}, [&](double) { return ++asked; }, {}, 20);
        for (std::size_t tick = 0; tick < 20; ++tick)
            EXPECT_EQ(run[tick].force_n, tick < delay ? 0.0 : static_cast<double>(tick - delay + 1)) << tick;
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
        return run_bench(
            bench, [](double position_m) { return -1500.0 * position_m; }, push, ticks);
    };
    const auto smooth = run(0.0);
    EXPECT_EQ(largest_force_n(smooth), arm.max_force_n);
    EXPECT_NEAR(growth_per_s(smooth, tick_s, ticks), 0.0, 0.01) << "a steady swing";
    const auto sticky = run(arm.coulomb_friction_n);
    EXPECT_EQ(sticky.back().state.velocity_m_per_s, 0.0);
    EXPECT_LT(largest_force_n(sticky), arm.coulomb_friction_n);
}

}  // namespace
}  // namespace osteomill::testing::bench_run_test
