#include "simulation/loop/histogram.h"

#include <gtest/gtest.h>

#include <limits>

namespace osteomill {
namespace {

TEST(Histogram, SaysZeroOfNothing) {
    const Histogram histogram;
    EXPECT_EQ(histogram.count(), 0u);
    EXPECT_EQ(histogram.quantile_s(0.99), 0.0);
    EXPECT_EQ(histogram.max_s(), 0.0);
}

TEST(Histogram, FindsQuantilesWithinThreePercentFromAboveOverSevenDecades) {
    for (const double unit_s : {1e-7, 1e-5, 1e-3, 1e-1}) {
        Histogram histogram;
        for (int i = 1; i <= 1000; ++i) histogram.add(unit_s * i);
        for (const double share : {0.5, 0.9, 0.99, 0.999}) {
            const double exact_s = unit_s * 1000.0 * share;
            EXPECT_GE(histogram.quantile_s(share), exact_s * (1.0 - 1e-9));
            EXPECT_LE(histogram.quantile_s(share), exact_s * 1.03);
        }
        EXPECT_EQ(histogram.quantile_s(1.0), unit_s * 1000);
    }
}

TEST(Histogram, KeepsTheLargestExactly) {
    Histogram histogram;
    histogram.add(0.000123456);
    histogram.add(0.000001);
    EXPECT_EQ(histogram.max_s(), 0.000123456);
    EXPECT_EQ(histogram.quantile_s(1.0), 0.000123456);
}

TEST(Histogram, ListsWhatItHasCountedByUpperEdge) {
    Histogram histogram;
    EXPECT_TRUE(histogram.filled().empty());
    for (const double seconds : {1e-5, 1e-5, 2e-3}) histogram.add(seconds);
    const auto filled = histogram.filled();
    ASSERT_EQ(filled.size(), 2u);
    EXPECT_EQ(filled[0].count, 2u);
    EXPECT_GE(filled[0].up_to_s, 1e-5);
    EXPECT_LT(filled[0].up_to_s, 1.03e-5);
    EXPECT_EQ(filled[1].count, 1u);
    EXPECT_EQ(filled[1].up_to_s, 2e-3) << "never above the maximum";
}

TEST(Histogram, TakesWhatNoClockShouldGive) {
    Histogram histogram;
    histogram.add(-1.0);
    histogram.add(std::numeric_limits<double>::quiet_NaN());
    histogram.add(1e9);
    EXPECT_EQ(histogram.count(), 3u);
    EXPECT_EQ(histogram.max_s(), 1e9);
    EXPECT_EQ(histogram.quantile_s(1.0), 1e9);
}

}  // namespace
}  // namespace osteomill
