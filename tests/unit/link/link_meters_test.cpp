#include "render_client/link/link_meters.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(DelayMeter, TellsTheDelayByTheClocksAndOverTheLeast) {
    const std::chrono::system_clock::time_point now{std::chrono::seconds(1'700'000'000)};
    const std::int64_t now_ns = 1'700'000'000'000'000'000;
    DelayMeter meter;
    EXPECT_NEAR(meter.update(now_ns - 30'000'000, now).by_clocks_s, 0.03, 1e-6);
    EXPECT_NEAR(meter.update(now_ns + 5'000'000'000, now).by_clocks_s, -5.0, 1e-6);
    const auto late = meter.update(now_ns + 4'900'000'000, now);
    EXPECT_NEAR(late.by_clocks_s, -4.9, 1e-6) << "the clocks differ";
    EXPECT_NEAR(late.over_least_s, 0.1, 1e-6) << "but this is right";
}

TEST(DelayMeter, TakesAnyStamp) {
    DelayMeter meter;
    EXPECT_GT(meter.update(std::numeric_limits<std::int64_t>::min(), {}).by_clocks_s, 9e9);
    EXPECT_LT(meter.update(std::numeric_limits<std::int64_t>::max(), {}).by_clocks_s, -9e9);
}

}  // namespace
}  // namespace osteomill
