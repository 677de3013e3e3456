#include "studies/stability/map/map_run.h"

#include <gtest/gtest.h>

#include "studies/stability/map/bench_device.h"

namespace osteomill::study::map_run_test {
namespace {

TEST(BenchDevice, GivesTheMotorsWhatTheyCanAfterTheDelay) {
    const MapCase c{.method = "hold", .delay_ticks = 2};
    ScenePlan plan = plan_of(c);
    plan.timing.guided = 0;
    BenchDevice device(c, plan);
    for (const double force_n : {1.0, 2.0, 3.0, 8.0, 9.0, 9.0}) {
        device.read(0.0);
        device.write({0.0, force_n, 0.0});
    }
    std::vector<double> given_n;
    for (const DeviceTick& tick : device.record()) given_n.push_back(tick.force_n.y);
    EXPECT_EQ(given_n, (std::vector<double>{0.0, 0.0, 1.0, 2.0, 3.0, 3.3}));
}

TEST(BenchDevice, HasEncoderStepsOnlyWhereItIsReal) {
    MapCase c{.method = "hold"};
    EXPECT_EQ(BenchDevice(c, plan_of(c)).limits().position_resolution_mm, 0.0);
    c.is_ideal_device = false;
    BenchDevice real(c, plan_of(c));
    const double steps = real.read(0.0).position_mm.x / real.limits().position_resolution_mm;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
}

TEST(MapRun, OfTheImplicitCouplingIsSteadyAndTrue) {
    const MapOutcome outcome = run_map_case({.method = "implicit", .grip = MapGrip::light});
    EXPECT_TRUE(outcome.is_stable);
    EXPECT_NEAR(outcome.resistance_n_s_per_m, 352.0, 4.0);
    EXPECT_NEAR(outcome.truth_mean_n, most_steady_force_n, 0.01);
    EXPECT_LT(outcome.rms_error_n, 0.03 * outcome.truth_mean_n);
    EXPECT_LT(outcome.mean_error_n, 0.02 * outcome.truth_mean_n);
    EXPECT_LT(outcome.largest_jump_n, 0.3);
    EXPECT_LT(outcome.depth_error_mm, 0.02);
    // A slot 1 mm deep: the segment of the burr's section, times the way in the window.
    EXPECT_NEAR(outcome.removed_mm3, 2.7956 * 0.399 * most_steady_force_n / 0.352, 0.1);
}

TEST(MapRun, OfForcesInterpolatedBetweenSlowStepsIsNot) {
    const MapOutcome outcome =
        run_map_case({.method = "interpolate", .grip = MapGrip::light, .milling_rate_hz = 100.0});
    EXPECT_FALSE(outcome.is_stable);
    EXPECT_GT(outcome.limit_cycle_n, 0.1);
    EXPECT_GT(outcome.injected_mj, 1.0);
}

TEST(MapRun, FindsTheKnownEdgeOfAWallThatIsHeldOneTickLate) {
    // 1406 N/m for the light grip, by the eigenvalues of hand, arm and wall one tick late.
    MapCase c{.method = "interpolate", .scene = MapScene::wall, .grip = MapGrip::light, .delay_ticks = 1};
    c.wall_n_per_mm = 1.1;
    EXPECT_TRUE(run_map_case(c).is_stable);
    c.wall_n_per_mm = 1.6;
    EXPECT_FALSE(run_map_case(c).is_stable);
}

}  // namespace
}  // namespace osteomill::study::map_run_test
