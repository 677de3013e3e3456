#include "render_client/ui/view/frame_times.h"

#include <gtest/gtest.h>

namespace osteomill::frame_times_test {
namespace {

TEST(FrameTimes, GivesPercentilesOfFramesInAnyOrder) {
    FrameTimes times;
    for (int ms = 101; ms >= 1; --ms) times.add(ms);
    EXPECT_EQ(times.percentile_ms(0.5), 51.0);
    EXPECT_EQ(times.percentile_ms(0.99), 100.0);
    EXPECT_EQ(times.percentile_ms(1.0), 101.0);
}

TEST(FrameTimes, IsZeroWithoutFrames) {
    EXPECT_EQ(FrameTimes().percentile_ms(0.5), 0.0);
}

}  // namespace
}  // namespace osteomill::frame_times_test
