#include "render_client/volume/passes/detail_control.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill::detail_control_test {
namespace {

constexpr std::int64_t pixels = 480'000;
constexpr double frame_s = 0.030;

/// A control that knows the cost of a pixel.
DetailControl knowing(double s_per_px, double rest_s = 0.0) {
    DetailControl control(frame_s);
    control.drew(Extent::whole, 1000, 1000 * s_per_px);
    if (rest_s > 0.0) control.frame_took(rest_s, 0.0);
    return control;
}

TEST(DetailControl, DrawsCoarselyWhileNothingIsKnownAndAfterThatAsWhatWasMeasuredAllows) {
    DetailControl control(frame_s);
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 4.0);
    control.drew(Extent::whole, pixels / 16, 1e-3);
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 1.0);
    control.forget_costs();
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 4.0);
}

TEST(DetailControl, DrawsInFullWhatFits) {
    DetailControl control = knowing(0.9 * frame_s / pixels);
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 1.0);
}

TEST(DetailControl, DividesBothEdgesByWhatBringsThePixelsWithinTheRoom) {
    // Four times as dear as would fit: a quarter of the pixels, half of each edge.
    DetailControl control = knowing(4.0 * frame_s / pixels);
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 2.0);
    EXPECT_NEAR(static_cast<double>(control.affordable_pixels(Extent::whole)), pixels / 4.0, 1.0);
}

TEST(DetailControl, GoesNoCoarserThanAQuarterAndInPartsThanAHalf) {
    DetailControl control = knowing(1.0);
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 4.0);
    EXPECT_EQ(control.divisor_for(Extent::parts, pixels), 2.0);
}

TEST(DetailControl, LeavesRoomForTheRestOfTheFrameButKeepsAQuarter) {
    const double s_per_px = frame_s / pixels;
    EXPECT_NEAR(static_cast<double>(knowing(s_per_px, 0.5 * frame_s).affordable_pixels(Extent::whole)),
                0.5 * pixels, 1.0);
    EXPECT_NEAR(static_cast<double>(knowing(s_per_px, 5.0 * frame_s).affordable_pixels(Extent::whole)),
                0.25 * pixels, 1.0);
}

TEST(DetailControl, CountsTheRestWithoutTheDrawingOfBone) {
    DetailControl control = knowing(frame_s / pixels);
    control.frame_took(frame_s, 0.75 * frame_s);
    EXPECT_NEAR(static_cast<double>(control.affordable_pixels(Extent::whole)), 0.75 * pixels, 1.0);
}

TEST(DetailControl, HoldsTheRateOfFramesWhateverAPixelCosts) {
    for (const double full_frame_s : {0.01, 0.05, 0.2, 0.3}) {
        DetailControl control(frame_s);
        double took_s = full_frame_s;
        for (int frame = 0; frame < 30; ++frame) {
            const double divisor = control.divisor_for(Extent::whole, pixels);
            // Work that does not depend on the pixels makes a pixel of a coarse frame dearer than one of a
            // fine frame.
            took_s = full_frame_s / (divisor * divisor) * (1.0 + 0.1 * divisor);
            control.drew(Extent::whole, static_cast<std::int64_t>(pixels / (divisor * divisor)), took_s);
        }
        EXPECT_LE(took_s, frame_s) << full_frame_s;
        EXPECT_GE(took_s, std::min(full_frame_s, 0.4 * frame_s)) << full_frame_s;
    }
}

TEST(DetailControl, DoesNotFlickerBetweenTwoResolutions) {
    DetailControl control(frame_s);
    double last = 0.0;
    int changes = 0;
    for (int frame = 0; frame < 100; ++frame) {
        const double noise = frame % 2 == 0 ? 1.06 : 0.94;
        const double divisor = control.divisor_for(Extent::whole, pixels);
        control.drew(Extent::whole, 1000, 1000 * noise * 2.25 * frame_s / pixels);
        if (frame > 10 && divisor != last) ++changes;
        last = divisor;
    }
    EXPECT_LE(changes, 1);
}

TEST(DetailControl, GetsFinerAgainWhenPixelsGetCheaper) {
    DetailControl control = knowing(8.9 * frame_s / pixels);
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 3.0);
    for (int frame = 0; frame < 30; ++frame) control.drew(Extent::whole, 1000, 1000 * 0.5 * frame_s / pixels);
    EXPECT_EQ(control.divisor_for(Extent::whole, pixels), 1.0);
}

TEST(DetailControl, TakesPartsToCostWhatTheWholeDoesUntilItKnowsBetter) {
    DetailControl control = knowing(frame_s / pixels);
    EXPECT_EQ(control.affordable_pixels(Extent::parts), control.affordable_pixels(Extent::whole));
    control.drew(Extent::parts, 1000, 1000 * 3.0 * frame_s / pixels);
    EXPECT_NEAR(static_cast<double>(control.affordable_pixels(Extent::parts)), pixels / 3.0, 1.0);
    EXPECT_NEAR(static_cast<double>(control.affordable_pixels(Extent::whole)), pixels, 1.0);
}

TEST(DetailControl, DoesNotTakeAFirstPartOfBackgroundForWhatAllPartsCost) {
    DetailControl control = knowing(frame_s / pixels);
    control.drew(Extent::parts, 2304, 1e-9);
    EXPECT_LT(control.affordable_pixels(Extent::parts), pixels * 1.3);
}

TEST(DetailControl, LearnsNothingFromNoPixelsAndNoTime) {
    DetailControl control(frame_s);
    control.drew(Extent::whole, 0, 1.0);
    control.drew(Extent::whole, 1000, 0.0);
    EXPECT_EQ(control.affordable_pixels(Extent::whole),
              DetailControl(frame_s).affordable_pixels(Extent::whole));
    EXPECT_THROW(DetailControl(0.0), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::detail_control_test
