#include "studies/stability/rails/force_response.h"

#include <gtest/gtest.h>

#include <complex>
#include <stdexcept>

namespace osteomill::study::force_response_test {
namespace {

TEST(ForceResponse, OfAForceThatIsHeldIsTheRigidOneATickLate) {
    const ForceResponse held = respond("hold", 1.5, 10.0);
    EXPECT_NEAR(std::abs(held.response), 1.0, 0.01);
    EXPECT_NEAR(std::arg(held.response), 0.0, 0.1);
}

TEST(ForceResponse, OfASpringFollowsASlowFeedAndNotAFastOne) {
    const double slow = std::abs(respond("implicit", 15.0, 1.0).response);
    const double fast = std::abs(respond("implicit", 1.5, 20.0).response);
    EXPECT_NEAR(slow, 1.0, 0.05);
    EXPECT_LT(fast, 0.05);
}

TEST(ForceResponse, RefusesAFrequencyThatItCannotMeasure) {
    EXPECT_THROW(respond("hold", 1.5, 0.0), std::invalid_argument);
    EXPECT_THROW(respond("hold", 1.5, 1000.0), std::invalid_argument);
    EXPECT_THROW(respond("nothing", 1.5, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study::force_response_test
