#include <gtest/gtest.h>

#include <vector>

#include "simulation/coupling/direct_coupling.h"

namespace osteomill::force_reconstruction_test {
namespace {

constexpr double tick_s = 0.001;

/// The force rendered at each tick for a model force along x, which takes a new value from `samples` every
/// `ticks_per_sample`.
std::vector<double> rendered(ForceReconstruction force, const std::vector<double>& samples,
                             int ticks_per_sample) {
    std::vector<double> result;
    int tick = 0;
    for (const double sample : samples) {
        force.add({sample, 0.0, 0.0}, tick_s * tick);
        for (int i = 0; i < ticks_per_sample; ++i, ++tick)
            result.push_back(force.over_tick(tick_s * tick, tick_s).x);
    }
    return result;
}

void expect_near(const std::vector<double>& actual, const std::vector<double>& expected) {
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(actual[i], expected[i], 1e-12) << i;
}

TEST(ForceReconstruction, HoldsTheNewestForce) {
    expect_near(rendered({ForceEstimate::newest, ForceShape::held, 2 * tick_s}, {1.0, 4.0}, 2),
                {1.0, 1.0, 4.0, 4.0});
}

TEST(ForceReconstruction, EstimatesTheMeanOfTheComingPeriod) {
    // 1.5 F_k - 0.5 F_{k-1}; and 2 F_k - 1.5 F_{k-1} + 0.5 F_{k-2}
    expect_near(rendered({ForceEstimate::trapezoid, ForceShape::held, tick_s}, {2.0, 4.0, 7.0, 7.0}, 1),
                {2.0, 5.0, 8.5, 7.0});
    expect_near(rendered({ForceEstimate::corrected, ForceShape::held, tick_s}, {2.0, 4.0, 7.0, 7.0}, 1),
                {2.0, 6.0, 9.0, 5.5});
}

TEST(ForceReconstruction, DrawsALineOverThePeriodThatFollowsASample) {
    expect_near(rendered({ForceEstimate::newest, ForceShape::line, 4 * tick_s}, {4.0, 0.0}, 4),
                {1.0, 2.0, 3.0, 4.0, 3.0, 2.0, 1.0, 0.0});
    expect_near(rendered({ForceEstimate::trapezoid, ForceShape::line, 2 * tick_s}, {4.0, 8.0}, 2),
                {2.0, 4.0, 7.0, 10.0});
}

TEST(ForceReconstruction, OfAModelAtTheHapticRateALineIsAHold) {
    expect_near(rendered({ForceEstimate::newest, ForceShape::line, tick_s}, {1.0, -2.0, 5.0}, 1),
                {1.0, -2.0, 5.0});
}

TEST(ForceReconstruction, ASampleThatComesEarlyTurnsTheLineWhereItIs) {
    // 300 Hz: samples after three and four ticks in turn.
    expect_near(rendered({ForceEstimate::newest, ForceShape::line, 4 * tick_s}, {4.0, -1.0}, 3),
                {1.0, 2.0, 3.0, 2.0, 1.0, 0.0});
}

TEST(ForceReconstruction, ForgetsOnReset) {
    ForceReconstruction force(ForceEstimate::corrected, ForceShape::line, tick_s);
    force.add({9.0, 0.0, 0.0}, 0.0);
    force.add({-3.0, 0.0, 0.0}, 0.001);
    force.reset();
    EXPECT_EQ(force.over_tick(0.002, tick_s), glm::dvec3(0.0));
    force.add({2.0, 0.0, 0.0}, 0.003);
    EXPECT_EQ(force.over_tick(0.003, tick_s).x, 2.0) << "no old force in the estimate";
}

}  // namespace
}  // namespace osteomill::force_reconstruction_test
