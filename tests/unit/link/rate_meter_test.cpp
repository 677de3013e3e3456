#include <gtest/gtest.h>

#include "render_client/link/link_meters.h"

namespace osteomill {
namespace {

using std::chrono::milliseconds;

TEST(RateMeter, TellsTheGrowthOverTheLastFullSecond) {
    const RateMeter::Time start{};
    RateMeter meter;
    EXPECT_EQ(meter.update(100, start), 0.0);
    EXPECT_EQ(meter.update(115, start + milliseconds(500)), 0.0);
    EXPECT_EQ(meter.update(130, start + milliseconds(1000)), 30.0);
    EXPECT_EQ(meter.update(500, start + milliseconds(1500)), 30.0);
    EXPECT_EQ(meter.update(500, start + milliseconds(3000)), 185.0);
    EXPECT_EQ(meter.update(500, start + milliseconds(4000)), 0.0);
}

}  // namespace
}  // namespace osteomill
