#include "analysis/output/time_left.h"

#include <gtest/gtest.h>

namespace osteomill::study {
namespace {

TEST(TimeLeft, FollowsFromWhatWasDone) {
    EXPECT_EQ(time_left(0, 10, 1.0), "");
    EXPECT_EQ(time_left(1, 10, 2.0), "18 s left");
    EXPECT_EQ(time_left(10, 100, 60.0), "9 min left");
    EXPECT_EQ(time_left(10, 1000, 60.0), "1 h 39 min left");
    EXPECT_EQ(time_left(10, 10, 5.0), "");
}

}  // namespace
}  // namespace osteomill::study
