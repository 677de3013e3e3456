#include <gtest/gtest.h>

#include "render_client/ui/panels/picture_marks.h"

namespace osteomill::scale_bar_test {
namespace {

TEST(ScaleBar, IsTheLongestRoundLengthThatFits) {
    const ScaleBar bar = scale_bar(0.05, 160.0);  // 8 mm would fit
    EXPECT_DOUBLE_EQ(bar.length_mm, 5.0);
    EXPECT_DOUBLE_EQ(bar.length_px, 100.0);
    EXPECT_EQ(bar.label, "5 mm");
    EXPECT_EQ(scale_bar(0.05, 200.0).label, "10 mm") << "a length that just fits";
    EXPECT_EQ(scale_bar(0.05, 199.0).label, "5 mm");
}

TEST(ScaleBar, CountsInMicrometresBelowAMillimetre) {
    EXPECT_EQ(scale_bar(0.002, 130.0).label, "200 µm");
    EXPECT_EQ(scale_bar(0.01, 100.0).label, "1 mm");
}

TEST(ScaleBar, FillsAtLeastTwoFifthsOfItsRoom) {
    for (double mm_per_px = 1e-4; mm_per_px < 10.0; mm_per_px *= 1.1) {
        const ScaleBar bar = scale_bar(mm_per_px, 150.0);
        EXPECT_LE(bar.length_px, 150.0 * (1.0 + 1e-6));
        EXPECT_GE(bar.length_px, 0.4 * 150.0 * (1.0 - 1e-6));
    }
}

}  // namespace
}  // namespace osteomill::scale_bar_test
