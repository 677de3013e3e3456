#include "studies/stability/linear_hold.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace osteomill::study::linear_hold_test {
namespace {

/// The force of a tick when the model's forces have been F_n = n for long, at sample 0.
double of_a_ramp(const std::vector<double>& weights) {
    double force = 0.0;
    for (std::size_t age = 0; age < weights.size(); ++age) force -= weights[age] * static_cast<double>(age);
    return force;
}

const std::vector<LinearHold> every_hold{zero_order_hold(),
                                         one_sample_late(),
                                         interpolated(10),
                                         sample_estimate_hold(10),
                                         corrected_sample_estimate_hold(),
                                         late_sample_estimate_hold(),
                                         late_by_ticks(interpolated(10), 3),
                                         of_estimates(interpolated(10)),
                                         then_estimated(interpolated(10))};

TEST(LinearHold, PassesASteadyForceUnchanged) {
    for (const LinearHold& hold : every_hold)
        for (const std::vector<double>& weights : hold.weights) {
            EXPECT_EQ(weights.size(), hold.forces_remembered());
            EXPECT_DOUBLE_EQ(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0);
        }
}

TEST(LinearHold, EstimatesTheMeanOfARampOverTheComingPeriod) {
    EXPECT_DOUBLE_EQ(of_a_ramp(sample_estimate_hold().weights[0]), 0.5);
    EXPECT_DOUBLE_EQ(of_a_ramp(corrected_sample_estimate_hold().weights[0]), 0.5);
    EXPECT_DOUBLE_EQ(of_a_ramp(late_sample_estimate_hold().weights[0]), 0.5);
    EXPECT_DOUBLE_EQ(of_a_ramp(zero_order_hold().weights[0]), 0.0);
    EXPECT_DOUBLE_EQ(of_a_ramp(one_sample_late().weights[0]), -1.0);
}

TEST(LinearHold, InterpolatesInEqualStridesToTheNewestForce) {
    const LinearHold hold = interpolated(10);
    ASSERT_EQ(hold.ticks_per_sample(), 10u);
    for (std::size_t tick = 0; tick < 10; ++tick)
        EXPECT_NEAR(of_a_ramp(hold.weights[tick]), -1.0 + 0.1 * static_cast<double>(tick + 1), 1e-15);
}

TEST(LinearHold, ReachesBackAcrossSamplesWhenLateByTicks) {
    const LinearHold late = late_by_ticks(interpolated(10), 3);
    for (std::size_t tick = 0; tick < 10; ++tick)
        EXPECT_NEAR(of_a_ramp(late.weights[tick]), -1.3 + 0.1 * static_cast<double>(tick + 1), 1e-15);
    // At the model's rate a tick late is a sample late, and ten ticks late are ten.
    EXPECT_EQ(late_by_ticks(zero_order_hold(), 1).weights, one_sample_late().weights);
    EXPECT_DOUBLE_EQ(of_a_ramp(late_by_ticks(zero_order_hold(), 10).weights[0]), -10.0);
    EXPECT_EQ(late_by_ticks(interpolated(10), 0).weights, interpolated(10).weights);
}

TEST(LinearHold, GainsHalfAPeriodByAnEstimateAtTheModelsRateAndHalfATickAfterInterpolation) {
    for (std::size_t tick = 0; tick < 10; ++tick) {
        const double plain = of_a_ramp(interpolated(10).weights[tick]);
        EXPECT_NEAR(of_a_ramp(of_estimates(interpolated(10)).weights[tick]), plain + 0.5, 1e-14);
        EXPECT_NEAR(of_a_ramp(then_estimated(interpolated(10)).weights[tick]), plain + 0.05, 1e-14);
    }
    EXPECT_EQ(then_estimated(zero_order_hold()).weights, sample_estimate_hold().weights);
}

TEST(LinearHold, NeedsAWeightAndATick) {
    EXPECT_THROW(held({}), std::invalid_argument);
    EXPECT_THROW(zero_order_hold(0), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study::linear_hold_test
