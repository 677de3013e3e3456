#include "simulation/loop/cut_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "simulation/exchange/change_queue.h"
#include "simulation/force_models/milling_model.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

constexpr double step_s = 0.001;

/// A burr that moves along x at 6 mm/s and touches bone at patches of these azimuths.
class Cut {
  public:
    explicit Cut(Burr burr, std::optional<Motor> motor = {}) : burr_(burr), report_({burr}, motor) {
        result_->spindle_on = true;
    }

    /// A patch at the equator, in bone of so much stiffness, by the law of EngagedPatch.
    void touch(double azimuth_rad, double stiffness = 1.0) {
        EngagedPatch& patch = result_->engagement.patches[result_->engagement.count++];
        patch.normal = {std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0};
        patch.area_mm2 = 0.02;
        const glm::dvec3 along_turn(-patch.normal.y, patch.normal.x, 0.0);
        const glm::dvec3& k = burr_.cutting_coefficients_n_per_mm2;
        patch.cutting_n_s_per_mm = -(burr_.sigma() * k.x * along_turn + k.y * patch.normal) * stiffness *
                                   patch.area_mm2 /
                                   (2.0 * std::numbers::pi * burr_.radius_mm() * burr_.spindle_rev_per_s);
        force_n_ += 6.0 * patch.normal.x * patch.cutting_n_s_per_mm;
    }

    std::optional<CutState> go_on(double time_s, bool cuts = true) {
        std::optional<CutState> told;
        for (double until_s = time_s_ + time_s; time_s_ < until_s; time_s_ += step_s) {
            result_->pose.position_mm.x = 6.0 * time_s_;
            result_->force_n = cuts ? force_n_ : glm::dvec3(0.0);
            report_.add(*result_, step_s);
            if (report_.is_due()) told = report_.take(*result_, 1.0);
        }
        return told;
    }

    double force_n() const { return glm::length(force_n_); }

  private:
    Burr burr_;
    CutReport report_;
    std::unique_ptr<MillingResult> result_ = std::make_unique<MillingResult>();
    glm::dvec3 force_n_{0.0};
    double time_s_ = 0.0;
};

Burr burr_of(int edges) {
    Burr burr{.diameter_mm = 2.0, .edges = edges, .spindle_rev_per_s = 500.0};
    burr.cutting_coefficients_n_per_mm2.z = 0.0;
    return burr;
}

TEST(CutReport, TellsForceStiffnessAndRippleOfACut) {
    Cut cut(burr_of(6));
    cut.touch(0.3, 2.5);
    const auto told = cut.go_on(1.0);
    ASSERT_TRUE(told);
    EXPECT_NEAR(told->force_n, cut.force_n(), 1e-6 * cut.force_n());
    EXPECT_NEAR(told->relative_stiffness, 2.5, 1e-6);
    // One place at which all edges pass: a train of pulses, whose first harmonic is twice the mean.
    EXPECT_NEAR(told->tooth_ripple_n, 2.0 * cut.force_n(), 1e-6 * cut.force_n());
    EXPECT_FALSE(told->loaded_rpm);
}

TEST(CutReport, HasNoRippleWhereAnEdgeEntersAsAnotherLeaves) {
    constexpr int edges = 64;
    constexpr double pitch_rad = 2.0 * std::numbers::pi / edges;
    Cut even(burr_of(edges));
    even.touch(0.25 * pitch_rad, 5.0);
    even.touch(-0.25 * pitch_rad, 5.0);
    const auto told = even.go_on(1.0);
    ASSERT_TRUE(told);
    EXPECT_LT(told->tooth_ripple_n, 0.1 * even.force_n()) << "all that is left turns with the edge";
    Cut together(burr_of(edges));
    together.touch(0.01 * pitch_rad, 5.0);
    together.touch(-0.01 * pitch_rad, 5.0);
    EXPECT_NEAR(together.go_on(1.0)->tooth_ripple_n, 2.0 * together.force_n(), 0.01 * together.force_n());
}

TEST(CutReport, IsNothingInAirAndSoonAfterACut) {
    Cut cut(burr_of(6));
    EXPECT_FALSE(cut.go_on(0.5));
    cut.touch(0.0, 5.0);
    cut.touch(0.4, 5.0);
    ASSERT_TRUE(cut.go_on(0.5));
    EXPECT_TRUE(cut.go_on(0.02, false)) << "hard bone gives way level by level";
    EXPECT_FALSE(cut.go_on(0.4, false));
}

TEST(CutReport, TellsWhatTheLoadLeavesOfTheSpeed) {
    // 230 N/mm^2 of 6 mm/s through 0.02 mm^2 at 1 mm from the axis, at 500 rev/s.
    const double torque_n_mm = 230.0 * 5.0 * 6.0 * 0.02 / (2.0 * std::numbers::pi * 500.0);
    const auto rpm_with = [&](const Motor& motor) {
        Cut cut(burr_of(6), motor);
        cut.touch(0.0, 5.0);
        return *cut.go_on(0.5)->loaded_rpm;
    };
    EXPECT_NEAR(rpm_with({.stall_torque_n_mm = 4.0 * torque_n_mm}), 22'500.0, 1.0);
    EXPECT_NEAR(rpm_with({.stall_torque_n_mm = 0.5 * torque_n_mm}), 0.0, 1e-9);
    EXPECT_NEAR(rpm_with({.stall_torque_n_mm = 4.0 * torque_n_mm, .steady_torque_n_mm = 2.0 * torque_n_mm}),
                30'000.0, 1e-9);
    EXPECT_NEAR(rpm_with({.stall_torque_n_mm = 1.5 * torque_n_mm, .steady_torque_n_mm = 0.5 * torque_n_mm}),
                15'000.0, 1.0);
}

TEST(CutReport, IsFiniteForOddResults) {
    CutReport report({burr_of(6)}, Motor{.stall_torque_n_mm = 1.0});
    auto result = std::make_unique<MillingResult>();
    result->spindle_on = true;
    result->force_n = {NAN, 0.0, 0.0};
    report.add(*result, 0.02);
    EXPECT_FALSE(report.take(*result, 1.0));
    result->force_n = {1.0, 0.0, 0.0};
    result->pose.position_mm.x = NAN;
    report.add(*result, 0.02);
    EXPECT_TRUE(std::isfinite(report.take(*result, 1.0)->tooth_ripple_n));
    result->burr = 7;
    report.add(*result, 0.02);
    EXPECT_FALSE(report.take(*result, 1.0));
}

/// The report of the milling model's own engagement agrees with the force that it milled with.
TEST(CutReport, OfTheMillingModelKnowsStiffnessAndTorqueOfTheBlock) {
    const Burr burr{.diameter_mm = 2.0, .edges = 6, .spindle_rev_per_s = 500.0};
    MillingModel model(testing::make_block({-3.0, -3.0, -2.0}, {3.0, 3.0, 0.0}, 0.1), {burr}, {}, {});
    ChangeQueue changes(1 << 22, model.bone().shared_content());
    CutReport report({burr}, Motor{.stall_torque_n_mm = 1.0});
    auto result = std::make_unique<MillingResult>();
    std::optional<CutState> told;
    double removed_mm3 = 0.0;
    for (int tick = 0; tick < 400; ++tick) {
        model.step({.pose = {{-2.0 + 0.006 * tick, 0.0, 0.4}, {0.0, 0.0, 1.0}},
                    .spindle_on = true,
                    .elapsed_s = step_s},
                   step_s * tick, changes, *result);
        report.add(*result, step_s);
        if (tick >= 200) removed_mm3 += result->removed_mm3;
        if (report.is_due()) told = report.take(*result, 1.0);
        changes.consume_all([](const BrickChange&, BrickFractions) {});
    }
    ASSERT_TRUE(told);
    EXPECT_NEAR(told->relative_stiffness, 1.0, 0.1);
    // Work of the edges: torque * 2 pi n = K_t * removed volume a second.
    const double torque_n_mm = 230.0 * removed_mm3 / 0.2 / (2.0 * std::numbers::pi * 500.0);
    EXPECT_NEAR(1.0 - *told->loaded_rpm / 30'000.0, torque_n_mm, 0.3 * torque_n_mm);
    EXPECT_GT(told->tooth_ripple_n, 0.0);
}

}  // namespace
}  // namespace osteomill
