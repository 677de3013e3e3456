#include "haptic_server/coupling/interpolated_coupling.h"

#include <gtest/gtest.h>

#include <memory>

namespace osteomill {
namespace {

HandState cutting_at(double now_s) {
    return {.now_s = now_s, .pose = {{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}, .spindle_on = true};
}

TEST(InterpolatedCoupling, DrawsALineBetweenTwoForcesOverOnePeriod) {
    InterpolatedCoupling coupling({.device = {}, .milling_period_s = 0.01});
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->force_n = {2.0, 0.0, 0.0};
    for (int tick = 0; tick <= 20; ++tick) {
        const CouplingOutput out = coupling.tick(cutting_at(0.001 * tick), *result);
        EXPECT_NEAR(out.force_n.x, 2.0 * std::min(1.0, tick / 10.0), 1e-12) << "tick " << tick;
        EXPECT_EQ(out.burr_pose.position_mm, glm::dvec3(1.0, 2.0, 3.0)) << "the burr is the device";
    }
    result->step = 2;
    result->force_n = {0.0, 1.0, 0.0};
    for (int tick = 21; tick <= 26; ++tick) (void)coupling.tick(cutting_at(0.001 * tick), *result);
    const glm::dvec3 half = coupling.tick(cutting_at(0.026), *result).force_n;
    EXPECT_NEAR(half.x, 1.0, 1e-12);
    EXPECT_NEAR(half.y, 0.5, 1e-12);
}

TEST(InterpolatedCoupling, ANewForceStartsFromWhatIsRenderedNow) {
    InterpolatedCoupling coupling({.device = {}, .milling_period_s = 0.01});
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->force_n = {1.0, 0.0, 0.0};
    (void)coupling.tick(cutting_at(0.0), *result);
    const double before = coupling.tick(cutting_at(0.004), *result).force_n.x;
    result->step = 2;
    result->force_n = {-5.0, 0.0, 0.0};
    EXPECT_NEAR(coupling.tick(cutting_at(0.004), *result).force_n.x, before, 1e-12);
}

TEST(InterpolatedCoupling, RendersAModelThatHoldsTheWallWithTheSpindleOff) {
    InterpolatedCoupling coupling({.device = {}, .milling_period_s = 0.01, .model_holds_wall = true});
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->force_n = {0.0, 0.0, 2.0};
    for (int tick = 0; tick <= 20; ++tick) {
        HandState hand = cutting_at(0.001 * tick);
        hand.spindle_on = tick > 10;
        const CouplingOutput out = coupling.tick(hand, *result);
        EXPECT_NEAR(out.force_n.z, 2.0 * std::min(1.0, tick / 10.0), 1e-12) << "tick " << tick;
        EXPECT_EQ(out.burr_pose.position_mm, hand.pose.position_mm) << "the burr is the device";
    }
}

}  // namespace
}  // namespace osteomill
