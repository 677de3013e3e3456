#include "analysis/calibration/force_regressors.h"

#include <gmock/gmock.h>

#include <numbers>

#include "analysis/calibration/steady_case.h"

namespace osteomill::study {
namespace {

TEST(ForceRegressors, OfAnUprightSlotAreThoseOfTheClosedForm) {
    const RunSetting s{.diameter_mm = 5.0, .rpm = 10'000.0, .feed_mm_per_s = 6.0, .depth_mm = 1.0};
    const double per_rev_mm = s.feed_mm_per_s / (s.rpm / 60.0);
    const double kappa = std::acos(1.0 - s.depth_mm / 2.5);
    const double i_s = 2.5 * (kappa / 2.0 - std::sin(2.0 * kappa) / 4.0);
    const double i_c = 2.5 * std::pow(std::sin(kappa), 2) / 2.0;
    const RunRegressors r = regressors_of(s);
    EXPECT_NEAR(r(0, 1), -0.25 * per_rev_mm * i_s, 2e-3 * per_rev_mm);
    EXPECT_NEAR(r(0, 2), -0.25 * per_rev_mm * i_c, 2e-3 * per_rev_mm);
    EXPECT_NEAR(std::abs(r(1, 0)), 0.25 * per_rev_mm * s.depth_mm, 2e-3 * per_rev_mm);
    EXPECT_NEAR(r(2, 1), per_rev_mm / std::numbers::pi * i_c, 2e-3 * per_rev_mm);
    // An edge that is engaged over half a turn: mean of cos psi 1/pi over the whole, arc R kappa.
    EXPECT_NEAR(std::abs(r(1, 3)), s.edges / std::numbers::pi * 2.5 * kappa, 0.01);
    // Seen from above, the front of a clockwise burr moves to the right: the bone there pushes it to the
    // left.
    EXPECT_GT(r(1, 0), 0.0);
    RunSetting other = s;
    other.turns = SpindleSense::counter_clockwise;
    EXPECT_NEAR(regressors_of(other)(1, 0), -r(1, 0), 1e-9);
}

TEST(ForceRegressors, AreAsExactAsADynamometerAsks) {
    for (const RunSetting& s :
         {RunSetting{.depth_mm = 0.1, .tilt_deg = 30.0, .tilt_direction_deg = 40.0},
          RunSetting{.depth_mm = 2.0, .tilt_deg = 60.0, .tilt_direction_deg = 180.0},
          RunSetting{.depth_mm = 0.8, .tilt_deg = 20.0, .previous_groove_mm_higher = 0.3}}) {
        SteadyCase c;
        c.burr.diameter_mm = s.diameter_mm;
        c.burr.edges = s.edges;
        c.burr.spindle_rev_per_s = s.rpm / 60.0;
        c.velocity_mm_per_s = {s.feed_mm_per_s, 0.0, 0.0};
        const double tilt = s.tilt_deg * std::numbers::pi / 180.0;
        const double toward = s.tilt_direction_deg * std::numbers::pi / 180.0;
        c.spindle_axis = {std::sin(tilt) * std::cos(toward), std::sin(tilt) * std::sin(toward),
                          std::cos(tilt)};
        c.depth_mm = s.depth_mm;
        c.previous_groove_mm_higher = s.previous_groove_mm_higher;
        c.burr.cutting_coefficients_n_per_mm2 = {230.0, 40.0, 20.0};
        c.burr.edge_coefficients_n_per_mm = {0.5, 0.8, 0.1};
        const glm::dvec3 fine_n =
            mean_reference_force_n(motion_of(c), bone_of(c), {.kappa = 480, .psi = 960});
        Eigen::Vector<double, 6> k;
        k << 230.0, 40.0, 20.0, 0.5, 0.8, 0.1;
        const Eigen::Vector3d force_n = regressors_of(s) * k;
        EXPECT_LT((force_n - Eigen::Vector3d(fine_n.x, fine_n.y, fine_n.z)).norm(), 3e-3 * force_n.norm());
    }
}

TEST(ForceRegressors, OfAnotherFeedAreScaledAsTheLawSays) {
    const RunSetting from{.rpm = 10'000.0, .feed_mm_per_s = 3.0, .tilt_deg = 20.0};
    RunSetting to = from;
    to.rpm = 25'000.0;
    to.feed_mm_per_s = 11.0;
    EXPECT_LT((at_other_feed(regressors_of(from), from, 11.0, 25'000.0) - regressors_of(to)).norm(), 1e-9);
}

}  // namespace
}  // namespace osteomill::study
