#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render_client/ui/panels/live_plot.h"

namespace osteomill::plot_lines_test {
namespace {

TEST(PlotRange, IsRoundAndHoldsTheValuesAndZero) {
    const PlotRange up = plot_range(0.3, 1.3, 0.2);
    EXPECT_DOUBLE_EQ(up.low, 0.0);
    EXPECT_DOUBLE_EQ(up.high, 2.0);
    const PlotRange both = plot_range(-0.12, 0.7, 0.2);
    EXPECT_DOUBLE_EQ(both.low, -0.2);
    EXPECT_DOUBLE_EQ(both.high, 1.0);
}

TEST(PlotRange, NeverMagnifiesNoise) {
    const PlotRange flat = plot_range(0.0, 0.0, 0.2);
    EXPECT_DOUBLE_EQ(flat.high - flat.low, 0.2);
    const PlotRange noise = plot_range(-0.001, 0.002, 0.2);
    EXPECT_GE(noise.high - noise.low, 0.2);
    EXPECT_LT(noise.low, 0.0);
    EXPECT_DOUBLE_EQ(plot_range(-0.01, 0.0, 0.2).low, -0.2);
}

TEST(PlotPoints, LieBetweenLongAgoAndNow) {
    const std::vector<PlotSample> samples{{12.0, 0.5}, {10.0, 0.0}, {5.0, 1.0}, {0.0, 3.0}};
    const auto points = plot_points(samples, 10.0, {0.0, 2.0}, {200.0f, 50.0f});
    ASSERT_EQ(points.size(), 3u) << "one is too old";
    EXPECT_EQ(points[0], glm::vec2(0.0f, 50.0f));
    EXPECT_EQ(points[1], glm::vec2(100.0f, 25.0f));
    EXPECT_EQ(points[2], glm::vec2(200.0f, 0.0f)) << "beyond the range is on its edge";
}

TEST(PlotPoints, AreAtMostTwoAPixelAndLoseNoPeak) {
    std::vector<PlotSample> samples;
    for (int i = 9999; i >= 0; --i) samples.push_back({1e-3 * i, std::sin(0.01 * i)});
    samples[4321].value = 7.0;
    const auto points = plot_points(samples, 10.0, {-1.0, 10.0}, {100.0f, 110.0f});
    EXPECT_LE(points.size(), 202u);
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](auto a, auto b) { return a.x < b.x; }));
    const auto highest =
        std::min_element(points.begin(), points.end(), [](auto a, auto b) { return a.y < b.y; });
    EXPECT_NEAR(highest->y, 30.0f, 0.01f);
}

}  // namespace
}  // namespace osteomill::plot_lines_test
