#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "simulation/force_models/force_model.h"

namespace osteomill::usable_burr_test {
namespace {

TEST(UsableBurr, HasADiameterAndEdgesAndTurns) {
    EXPECT_NO_THROW(require_valid(Burr{}, 0.1));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Burr& bad :
         {Burr{.diameter_mm = 0.0}, Burr{.diameter_mm = nan}, Burr{.edges = 0},
          Burr{.spindle_rev_per_s = -1.0}, Burr{.cutting_coefficients_n_per_mm2 = {230.0, -1.0, 20.0}}})
        EXPECT_THROW(require_valid(bad, 0.1), std::invalid_argument);
}

TEST(UsableBurr, IsAtMostFiveHundredVoxelsAcross) {
    EXPECT_NO_THROW(require_valid(Burr{.diameter_mm = 5.0}, 0.01));
    EXPECT_THROW(require_valid(Burr{.diameter_mm = 5.1}, 0.01), std::invalid_argument);
}

TEST(UsableCommand, IsFiniteLastsAndNamesABurr) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const BurrCommand good{.pose = {{1.0, 2.0, 3.0}, {0.0, 0.6, 0.8}}, .burr = 1, .elapsed_s = 0.001};
    EXPECT_TRUE(is_usable(good, 2));
    EXPECT_FALSE(is_usable(good, 1));
    for (const double elapsed_s : {0.0, -0.001, nan}) {
        BurrCommand bad = good;
        bad.elapsed_s = elapsed_s;
        EXPECT_FALSE(is_usable(bad, 2)) << elapsed_s;
    }
    BurrCommand bad = good;
    bad.pose.position_mm.y = nan;
    EXPECT_FALSE(is_usable(bad, 2));
    bad = good;
    bad.pose.spindle_axis = {0.0, 0.6, 0.7};
    EXPECT_FALSE(is_usable(bad, 2)) << "the axis is of unit length";
}

}  // namespace
}  // namespace osteomill::usable_burr_test
