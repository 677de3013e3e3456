#include "studies/stability/needed_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace osteomill::study::needed_damping_test {
namespace {

constexpr double tick_s = 1e-3;
constexpr double nyquist = std::numbers::pi;

TEST(NeededDamping, IsHalfTheStiffnessTimesThePeriodAndTheDamper) {
    for (const double k : {0.0, 1000.0, 4000.0})
        for (const double b : {-0.7, -0.1, 0.0, 0.4, 2.0}) {
            const ModelForce model{.stiffness_n_per_m = k, .damping_n_s_per_m = b};
            const WorstFrequency worst = worst_frequency(model, zero_order_hold(), tick_s);
            EXPECT_NEAR(worst.needed_damping_n_s_per_m, 0.5 * k * tick_s + std::abs(b), 1e-5)
                << k << ' ' << b;
            if (b > 0.0) {
                EXPECT_DOUBLE_EQ(worst.angle, nyquist);
            }
            if (b < 0.0) {
                EXPECT_LT(worst.angle, 0.01);
            }
        }
}

TEST(NeededDamping, IsThreeTimesAsMuchForAHoldThatIsASampleLate) {
    const WorstFrequency worst = worst_frequency(wall(1000.0), one_sample_late(), tick_s);
    EXPECT_NEAR(worst.needed_damping_n_s_per_m, 1.5 * 1000.0 * tick_s, 1e-4);
    EXPECT_LT(worst.angle, 0.01);
}

TEST(NeededDamping, OfSampleEstimateHoldIsNothingSlowlyButTwiceTheHoldsAtNyquist) {
    const LinearHold hold = sample_estimate_hold();
    EXPECT_NEAR(needed_damping_n_s_per_m(wall(1000.0), hold, tick_s, 0.01), 0.0, 1e-4);
    EXPECT_NEAR(needed_damping_n_s_per_m(wall(1000.0), hold, tick_s, nyquist), 1000.0 * tick_s, 1e-12);
    EXPECT_DOUBLE_EQ(worst_frequency(wall(1000.0), hold, tick_s).angle, nyquist);
}

TEST(NeededDamping, DoesNotApplyWhereTheModelIsSlowerThanTheTicks) {
    EXPECT_THROW(needed_damping_n_s_per_m(wall(1.0), interpolated(10), tick_s, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study::needed_damping_test
