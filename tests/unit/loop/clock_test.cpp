#include "simulation/loop/clock.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(RealClock, NeverReturnsBeforeTheTimeAskedFor) {
    RealClock clock;
    for (const double time_s : {0.0005, 0.001, 0.004, 0.00405}) {
        clock.sleep_until(time_s);
        EXPECT_GE(clock.now_s(), time_s);
    }
}

TEST(RealClock, ReturnsAtOnceForATimeThatHasPassed) {
    RealClock clock;
    clock.sleep_until(-100.0);
    SUCCEED();
}

TEST(RealClock, NeverGoesBack) {
    RealClock clock;
    double before_s = clock.now_s();
    for (int i = 0; i < 1000; ++i) {
        const double now_s = clock.now_s();
        ASSERT_GE(now_s, before_s);
        before_s = now_s;
    }
}

}  // namespace
}  // namespace osteomill
