#include "studies/stability/sampled_force.h"

#include <gtest/gtest.h>

namespace osteomill::study::sampled_force_test {
namespace {

TEST(SampledForce, ResistsTheSampleUntilTheNext) {
    SampledForce force(wall(1000.0), zero_order_hold(3), 1e-3);
    EXPECT_DOUBLE_EQ(force(0.001), -1.0);
    EXPECT_DOUBLE_EQ(force(0.002), -1.0);
    EXPECT_DOUBLE_EQ(force(0.003), -1.0);
    EXPECT_DOUBLE_EQ(force(0.004), -4.0);
}

TEST(SampledForce, TakesTheVelocityFromTwoSamplesOfTheModel) {
    SampledForce force(damper(5.0), zero_order_hold(2), 1e-3);
    EXPECT_DOUBLE_EQ(force(0.0), 0.0);
    EXPECT_DOUBLE_EQ(force(0.5), 0.0);  // between samples: not seen
    EXPECT_DOUBLE_EQ(force(0.004), -5.0 * 0.004 / 2e-3);
}

TEST(SampledForce, MixesOldForcesByTheirWeights) {
    SampledForce force(wall(1000.0), corrected_sample_estimate_hold(), 1e-3);
    force(0.001);
    force(0.002);
    EXPECT_DOUBLE_EQ(force(0.004), -(2.0 * 4.0 - 1.5 * 2.0 + 0.5 * 1.0));
}

TEST(SampledForce, ReachesTheNewestForceAtTheEndOfThePeriod) {
    SampledForce force(wall(1000.0), interpolated(4), 1e-3);
    for (const double expected : {-0.25, -0.5, -0.75, -1.0}) EXPECT_DOUBLE_EQ(force(0.001), expected);
    EXPECT_DOUBLE_EQ(force(0.003), -1.5);
}

}  // namespace
}  // namespace osteomill::study::sampled_force_test
