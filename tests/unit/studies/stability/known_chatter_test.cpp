// How hard held cutting forces chatter: a hand that means to feed the burr into bone at 6 mm/s, against known
// values of the force's rms about its mean. The motors' limit bounds the swings, so these are limit cycles
// and judge the run where eigenvalues cannot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "studies/stability/bench_run.h"
#include "studies/stability/bone_front.h"
#include "studies/stability/sampled_force.h"

namespace osteomill::study::known_chatter_test {
namespace {

constexpr double tick_s = 1e-3;
constexpr double feed_m_per_s = 6e-3;

struct SteadyForce {
    double mean_n = 0.0;
    double rms_about_mean_n = 0.0;
};

/// From the fourth second to the eighth. The run's positions are measured from where the hand means to be.
SteadyForce steady_force(double cutting_n_s_per_m, const LinearHold& hold) {
    const Bench bench{.body = {.mass_kg = 0.045, .damping_n_s_per_m = 2.0, .hand_stiffness_n_per_m = 300.0},
                      .max_force_n = 3.3};
    SampledForce force(BoneFront(cutting_n_s_per_m), hold, tick_s);
    double meant_m = 0.0;
    const auto law = [&](double from_meant_m) {
        const double force_n = force(meant_m + from_meant_m);
        meant_m += feed_m_per_s * tick_s;
        return force_n;
    };
    const auto run = run_bench(bench, law, {}, 8000);
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = run.size() / 2; i < run.size(); ++i) {
        sum += run[i].force_n;
        squares += run[i].force_n * run[i].force_n;
    }
    const double count = static_cast<double>(run.size() / 2);
    const double mean_n = sum / count;
    return {-mean_n, std::sqrt(std::max(0.0, squares / count - mean_n * mean_n))};
}

TEST(KnownChatter, OfACuttingForceHeldAt100Hz) {
    const LinearHold hold = zero_order_hold(10);
    EXPECT_NEAR(steady_force(20.0, hold).rms_about_mean_n, 0.25, 0.015);
    EXPECT_NEAR(steady_force(60.0, hold).rms_about_mean_n, 0.81, 0.025);
    for (const double cutting : {110.0, 300.0, 680.0})
        EXPECT_NEAR(steady_force(cutting, hold).rms_about_mean_n, 1.23, 0.037) << cutting;
}

TEST(KnownChatter, OfACuttingForceHeldAt1000HzBeginsBetween60And110) {
    const LinearHold hold = zero_order_hold();
    for (const double cutting : {20.0, 60.0}) {
        const SteadyForce force = steady_force(cutting, hold);
        EXPECT_NEAR(force.mean_n, cutting * feed_m_per_s, 1e-6);
        EXPECT_LT(force.rms_about_mean_n, 1e-6) << "it cuts steadily";
    }
    EXPECT_NEAR(steady_force(110.0, hold).rms_about_mean_n, 1.23, 0.037);
    EXPECT_NEAR(steady_force(300.0, hold).rms_about_mean_n, 1.21, 0.037);
    EXPECT_NEAR(steady_force(680.0, hold).rms_about_mean_n, 1.19, 0.037);
}

}  // namespace
}  // namespace osteomill::study::known_chatter_test
