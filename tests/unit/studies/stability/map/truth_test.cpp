#include "studies/stability/map/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill::study::truth_test {
namespace {

ScenePlan short_plan(const MapCase& c, std::size_t ticks) {
    ScenePlan plan = plan_of(c);
    plan.timing = {.settling = 0, .window = ticks, .tail = 0};
    return plan;
}

TEST(Truth, StaysInTheSteadyStateThatItBeginsIn) {
    for (const char* method : {"implicit", "hold"}) {
        const ScenePlan plan = short_plan({.method = method, .grip = MapGrip::light, .depth_mm = 2.5}, 60);
        const TruthTick last = truth_of(plan).back();
        EXPECT_LT(glm::distance(last.force_n, plan.steady_force_n), 0.005 * glm::length(plan.steady_force_n));
        EXPECT_NEAR(last.burr_mm.x, plan.burr_at_release_mm.x + 0.059 * plan.feed_mm_per_s, 0.005);
    }
}

/// The hand pulls elsewhere from the release on.
ScenePlan disturbed_plan(const char* method) {
    ScenePlan plan = short_plan({.method = method, .grip = MapGrip::light}, 30);
    plan.intent.target_mm += glm::dvec3(3.0, 1.0, -2.0);
    return plan;
}

/// The disturbance makes the first few milliseconds ring faster than anybody judges.
constexpr std::size_t shaken_ticks = 5;

TEST(Truth, DoesNotDependOnTheSubstep) {
    for (const char* method : {"implicit", "hold"}) {
        const ScenePlan plan = disturbed_plan(method);
        const auto coarse = truth_of(plan, 100);
        const auto fine = truth_of(plan, 200);
        EXPECT_GT(glm::distance(fine.back().force_n, plan.steady_force_n), 0.1);
        for (std::size_t i = shaken_ticks; i < coarse.size(); ++i) {
            EXPECT_LT(glm::distance(coarse[i].force_n, fine[i].force_n), 0.005 * glm::length(fine[i].force_n))
                << method << i;
            EXPECT_LT(glm::distance(coarse[i].tool_mm, fine[i].tool_mm), 1e-3) << method << i;
        }
    }
}

TEST(Truth, OfAVeryStiffMountIsThatOfARigidOne) {
    const auto rigid = truth_of(disturbed_plan("hold"));
    ScenePlan plan = disturbed_plan("hold");
    plan.mount = {.stiffness_n_per_mm = 1e5};
    const auto stiff = truth_of(plan);
    for (std::size_t i = shaken_ticks; i < rigid.size(); ++i) {
        EXPECT_LT(glm::distance(rigid[i].force_n, stiff[i].force_n), 0.01 * glm::length(rigid[i].force_n))
            << i;
        EXPECT_LT(glm::distance(rigid[i].tool_mm, stiff[i].tool_mm), 0.002) << i;
    }
}

TEST(Truth, OfAWallIsASpringInContinuousTime) {
    const ScenePlan plan = short_plan(
        {.method = "hold", .scene = MapScene::wall, .grip = MapGrip::bare_arm, .wall_n_per_mm = 1.5}, 12);
    const auto record = truth_of(plan);
    // m x'' + b x' + k x = 1 N from x = 0, x' = 3 mm/s, pushed in by x.
    const double decay = 0.5 * 0.5 / 0.045;
    const double omega = std::sqrt(1500.0 / 0.045 - decay * decay);
    const double rest_mm = 1.0 / 1.5;
    for (std::size_t i = 0; i < record.size(); ++i) {
        const double t = tick_s * static_cast<double>(i);
        const double sine = (touch_mm_per_s - decay * rest_mm) / omega;
        const double x_mm =
            rest_mm + std::exp(-decay * t) * (-rest_mm * std::cos(omega * t) + sine * std::sin(omega * t));
        EXPECT_NEAR(record[i].force_n.z, 1.5 * x_mm, 0.01) << i;
    }
}

TEST(Truth, OfAWallComesToRestUnderTheHandsPush) {
    const ScenePlan plan =
        short_plan({.method = "implicit", .scene = MapScene::wall, .grip = MapGrip::light}, 600);
    EXPECT_NEAR(truth_of(plan).back().force_n.z, wall_push_n, 0.01);
}

}  // namespace
}  // namespace osteomill::study::truth_test
