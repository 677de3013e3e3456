#include "simulation/loop/clock.h"

#include <gtest/gtest.h>

#include "simulation/loop/periodic_loop.h"

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

/// A system's clock that a test sets.
class SetClock : public ::testing::Test {
  protected:
    SetClock() { set_s = 0.0; }
    static double system_s() noexcept { return RealClock::boot_time_s() + set_s; }
    static inline double set_s = 0.0;
};

TEST_F(SetClock, SetBackGoesOnFromTheLatestTime) {
    RealClock clock(system_s);
    clock.sleep_until(0.005);
    for (const double back_s : {-0.01, -3600.0, -1e9}) {
        const double before_s = clock.now_s();
        set_s += back_s;
        for (int i = 0; i < 100; ++i) ASSERT_GE(clock.now_s(), before_s);
        clock.sleep_until(before_s + 0.003);  // not an hour
        EXPECT_GE(clock.now_s(), before_s + 0.003);
    }
}

TEST_F(SetClock, SetForwardFindsThatTimeHasPassed) {
    RealClock clock(system_s);
    clock.sleep_until(0.002);
    set_s = 3600.0;
    EXPECT_GE(clock.now_s(), 3600.0);
    clock.sleep_until(3600.001);
    EXPECT_GE(clock.now_s(), 3600.001);
}

TEST_F(SetClock, LetsALoopTickOnWhereItIsSetBack) {
    RealClock clock(system_s);
    double last_s = -1.0;
    PeriodicLoop loop(0.001, 0.0, [&](double time_s, std::uint64_t) {
        EXPECT_GT(time_s, last_s);
        last_s = time_s;
    });
    for (int i = 0; i < 50; ++i) {
        if (i % 10 == 5) set_s -= 1000.0;
        loop.wait_and_tick(clock);
    }
    EXPECT_GE(last_s, 0.049 - 1e-9);
}

}  // namespace
}  // namespace osteomill
