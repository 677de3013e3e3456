#include "haptic_server/device/delay_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptic_server/coupling/coupling_spring.h"
#include "studies/stability/bench_run.h"

namespace osteomill {
namespace {

/// Growth of a push against a wall behind the coupling's spring, on an arm that nobody holds, so many ticks
/// late.
double growth_per_s(double stiffness_n_per_mm, std::size_t delay_ticks) {
    constexpr double tick_s = 0.001;
    constexpr std::size_t ticks = 3000;
    CouplingSpring spring({.max_stiffness_n_per_mm = stiffness_n_per_mm}, 0.01);
    spring.place(glm::dvec3(0.0));
    const study::Bench bench{.body = study::bare_arm(0.5), .delay_ticks = delay_ticks};
    const auto law = [&](double position_m) {
        // A wall that holds the burr, pulled at or pushed: the spring alone is what may be unstable.
        spring.follow_hand(glm::dvec3(1000.0 * position_m, 0.0, 0.0), tick_s);
        return spring.follow_burr(glm::dvec3(0.0), tick_s).x;
    };
    return study::growth_per_s(study::run_bench(bench, law, study::push, ticks, 0.1), tick_s, ticks);
}

TEST(DelayStiffness, HoldsAWallAtEachDelayWithAThirdToSpare) {
    const double arms_n_per_mm = 1.5;
    for (std::size_t ticks = 0; 0.001 * static_cast<double>(ticks) <= longest_delay_s; ++ticks) {
        const double share = stiffness_share(0.001 * static_cast<double>(ticks));
        EXPECT_LT(growth_per_s(arms_n_per_mm * share, ticks), 0.0) << ticks;
        EXPECT_LT(growth_per_s(1.33 * arms_n_per_mm * share, ticks), 0.0) << ticks;
    }
    // And it is the delay that asks for it: without the share the arm shakes.
    EXPECT_GT(growth_per_s(arms_n_per_mm, 2), 0.0);
    EXPECT_GT(growth_per_s(arms_n_per_mm, 5), 0.0);
    EXPECT_GT(growth_per_s(0.0, 20), 0.0) << "far away the damper alone does it";
}

TEST(DelayStiffness, IsTheArmsOwnUpToATick) {
    for (const double delay_s : {0.0, 0.0005, 0.001, -1.0, std::nan("")})
        EXPECT_EQ(stiffness_share(delay_s), 1.0);
    EXPECT_NEAR(stiffness_share(0.002), 0.608, 0.001);
    EXPECT_LT(stiffness_share(0.05), 0.04);
}

}  // namespace
}  // namespace osteomill
