#include "studies/stability/largest_stable.h"

#include <gtest/gtest.h>

namespace osteomill::study::largest_stable_test {
namespace {

TEST(LargestStable, FindsTheEdge) {
    EXPECT_NEAR(largest_stable([](double gain) { return gain < 1234.5; }), 1234.5, 0.13);
}

TEST(LargestStable, StopsAtTheFirstEdgeOfSeveral) {
    EXPECT_NEAR(largest_stable([](double gain) { return gain < 10.0 || (gain > 20.0 && gain < 30.0); }), 10.0,
                0.001);
}

TEST(LargestStable, ReturnsTheEndsOfTheRangeWhereThereIsNoEdge) {
    EXPECT_EQ(largest_stable([](double) { return true; }, {.from = 2.0, .to = 50.0}), 50.0);
    EXPECT_EQ(largest_stable([](double) { return false; }, {.from = 2.0, .to = 50.0}), 2.0);
}

}  // namespace
}  // namespace osteomill::study::largest_stable_test
