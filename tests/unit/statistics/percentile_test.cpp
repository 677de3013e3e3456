#include "common/statistics/percentile.h"

#include <gtest/gtest.h>

namespace osteomill::percentile_test {
namespace {

TEST(Percentile, IsInterpolatedLinearly) {
    const std::vector<double> values{5.0, 1.0, 4.0, 2.0};
    EXPECT_EQ(percentile(values, 0.0), 1.0);
    EXPECT_EQ(percentile(values, 0.5), 3.0);
    EXPECT_DOUBLE_EQ(percentile(values, 0.9), 4.7);
    EXPECT_EQ(percentile(values, 1.0), 5.0);
}

TEST(Percentile, OfOneValueOrNone) {
    EXPECT_EQ(percentile(std::vector<double>{3.0}, 0.99), 3.0);
    EXPECT_EQ(percentile({}, 0.5), 0.0);
}

}  // namespace
}  // namespace osteomill::percentile_test
