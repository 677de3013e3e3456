#include "studies/stability/sites/site_verdict.h"

#include <gtest/gtest.h>

namespace osteomill::study::site_verdict_test {
namespace {

const glm::dvec3 along_x(1.0, 0.0, 0.0);

/// A second of 1 N against a hand that goes 10 mm/s along x, and a model that says the same.
SiteRun steady() {
    SiteRun run;
    for (int i = 0; i < 1000; ++i)
        run.ticks.push_back({.hand_mm = 0.01 * i * along_x,
                             .burr_mm = 0.01 * i * along_x,
                             .force_n = -along_x,
                             .spindle_on = true,
                             .model_n = -along_x,
                             .rigid_n = -along_x});
    return run;
}

TEST(SiteVerdict, FindsNothingWhereTheForceIsTheModels) {
    const SiteVerdict verdict = verdict_on(steady());
    EXPECT_EQ(verdict.energy_over_rigid_mj, 0.0);
    EXPECT_EQ(verdict.stuck_ms, 0.0);
    EXPECT_NEAR(verdict.error_percent, 0.0, 1e-9);
    EXPECT_EQ(verdict.largest_jump_n, 0.0);
    EXPECT_EQ(verdict.peak_n, 1.0);
}

TEST(SiteVerdict, CountsEnergyThatARigidBurrWouldNotGive) {
    SiteRun run = steady();
    for (std::size_t i = 400; i < 600; ++i) run.ticks[i].force_n = 2.0 * along_x;
    EXPECT_NEAR(verdict_on(run).energy_over_rigid_mj, 4.0, 1e-9);
    for (std::size_t i = 401; i < 601; ++i) run.ticks[i].rigid_n = 2.0 * along_x;
    EXPECT_NEAR(verdict_on(run).energy_over_rigid_mj, 0.0, 1e-9);
}

TEST(SiteVerdict, TimesAForceThatNothingCutExplains) {
    SiteRun run = steady();
    for (std::size_t i = 400; i < 520; ++i) run.ticks[i].model_n = glm::dvec3(0.0);
    // The model's mean over 20 ms is under 0.1 N for 102 of the 120 ms.
    EXPECT_NEAR(verdict_on(run).stuck_ms, 102.0, 2.0);
    for (std::size_t i = 400; i < 520; ++i) run.ticks[i].spindle_on = false;
    EXPECT_EQ(verdict_on(run).stuck_ms, 0.0) << "a wall";
}

TEST(SiteVerdict, MeasuresTheErrorOverTwentyMilliseconds) {
    SiteRun run = steady();
    for (std::size_t i = 400; i < 500; ++i) run.ticks[i].force_n = -1.1 * along_x;
    EXPECT_NEAR(verdict_on(run).error_percent, 10.0, 1e-9);
}

TEST(SiteVerdict, CountsTheErrorByItselfWhereBoneDrivesTheBurr) {
    SiteRun run = steady();
    for (std::size_t i = 400; i < 500; ++i) run.ticks[i].model_n = along_x;
    const SiteVerdict verdict = verdict_on(run);
    EXPECT_NEAR(verdict.error_while_driven_percent, 200.0, 1e-9);
    EXPECT_LE(verdict.error_percent, 100.0) << "at most ten of a window's twenty ticks";
}

TEST(SiteVerdict, FindsAJumpInOneTick) {
    SiteRun run = steady();
    run.ticks[500].force_n = -1.4 * along_x;
    EXPECT_NEAR(verdict_on(run).largest_jump_n, 0.4, 1e-9);
}

}  // namespace
}  // namespace osteomill::study::site_verdict_test
