#include "render_client/ui/input/wheel_step.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

/// Counts notches for the whole way, with the bone in sight.
int notches_for(double way_mm, double mm_per_px) {
    int notches = 0;
    for (double left_mm = way_mm; left_mm > 0.05 && notches < 1000; ++notches)
        left_mm -= wheel_step_mm(mm_per_px, left_mm);
    return notches;
}

TEST(WheelStep, IsFastInAirAndFineAtTheBone) {
    EXPECT_LE(notches_for(12.0, 0.05), 16) << "from where a mastoidectomy begins";
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.05, 0.0), 0.1);
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.05, std::nullopt), 3.0);
    EXPECT_GT(wheel_step_mm(0.05, 5.0), 10.0 * wheel_step_mm(0.05, 0.0));
}

TEST(WheelStep, FollowsTheZoomAtTheBone) {
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.02, 0.0), 0.04);
    EXPECT_DOUBLE_EQ(wheel_step_mm(0.001, 0.0), 0.02);
    EXPECT_DOUBLE_EQ(wheel_step_mm(1.0, 0.0), 0.2);
}

TEST(WheelStep, GoesThroughNoBone) {
    for (double ahead_mm = 0.0; ahead_mm < 30.0; ahead_mm += 0.01)
        EXPECT_LE(wheel_step_mm(0.05, ahead_mm), std::max(0.1, 0.3 * ahead_mm + 1e-12));
}

}  // namespace
}  // namespace osteomill
