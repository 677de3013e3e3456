#include "simulation/safety/watchdog.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteomill::watchdog_test {
namespace {

constexpr double tick_s = 0.001;

/// Feeds a watchdog tick by tick; all is well unless a test says otherwise.
class Watched {
  public:
    Watchdog watchdog{tick_s};
    Observation seen;

    FaultSet tick(bool model_runs = true) {
        seen.now_s += tick_s * static_cast<double>(1 + seen.missed_periods);
        if (model_runs) ++seen.model_step;
        const FaultSet found = watchdog.check(seen);
        seen.missed_periods = 0;
        return found;
    }
};

TEST(Watchdog, IsQuietWhileAllIsWell) {
    Watched watched;
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(watched.tick(), Fault::none);
}

TEST(Watchdog, NamesADeviceThatIsNotThere) {
    Watched watched;
    watched.tick();
    watched.seen.device.connected = false;
    EXPECT_EQ(watched.tick(), Fault::device_lost);
}

TEST(Watchdog, TakesAPositionThatIsNotANumberForALostDevice) {
    Watched watched;
    watched.seen.device.position_mm.y = NAN;
    EXPECT_EQ(watched.tick(), Fault::device_lost);
    watched.seen.device = {};
    watched.seen.device.spindle_axis.x = INFINITY;
    EXPECT_EQ(watched.tick(), Fault::device_lost);
}

TEST(Watchdog, NamesAJumpOnceAndNotTheFastestHand) {
    Watched watched;
    watched.tick();
    for (int i = 0; i < 100; ++i) {
        watched.seen.device.position_mm.x += 2.0;  // 2 m/s
        ASSERT_EQ(watched.tick(), Fault::none);
    }
    watched.seen.device.position_mm.x += 10.0;
    EXPECT_EQ(watched.tick(), Fault::device_jumped);
    EXPECT_EQ(watched.tick(), Fault::none);
}

TEST(Watchdog, AllowsAHandToMoveOnWhileTicksWereMissed) {
    Watched watched;
    watched.tick();
    watched.seen.device.position_mm.x += 10.0;
    watched.seen.missed_periods = 9;
    EXPECT_EQ(watched.tick(), Fault::none);
}

TEST(Watchdog, DoesNotCallItAJumpWhenALostDeviceReturnsElsewhere) {
    Watched watched;
    watched.tick();
    watched.seen.device.connected = false;
    watched.tick();
    watched.seen.device = {.position_mm = {80.0, 0.0, 0.0}};
    EXPECT_EQ(watched.tick(), Fault::none);
}

TEST(Watchdog, WaitsFiftyMillisecondsForAFreshModelResult) {
    Watched watched;
    watched.tick();
    for (int i = 0; i < 49; ++i) ASSERT_EQ(watched.tick(false), Fault::none) << "ms " << i;
    watched.tick(false);  // the fiftieth: either, by rounding
    EXPECT_EQ(watched.tick(false), Fault::model_stalled);
    EXPECT_EQ(watched.tick(true), Fault::none);
}

TEST(Watchdog, DoesNotWaitForeverForTheFirstResult) {
    Watched watched;
    FaultSet found;
    for (int i = 0; i < 52; ++i) found = watched.tick(false);
    EXPECT_EQ(found, Fault::model_stalled);
}

TEST(Watchdog, NamesAResultThatIsNoResult) {
    Watched watched;
    watched.seen.model_valid = false;
    EXPECT_EQ(watched.tick(), Fault::not_a_number);
}

TEST(Watchdog, NamesAStreakOfMissedDeadlines) {
    Watched watched;
    for (int i = 0; i < 9; ++i) {
        watched.seen.missed_periods = 2;
        ASSERT_EQ(watched.tick(), Fault::none);
    }
    watched.seen.missed_periods = 2;
    EXPECT_EQ(watched.tick(), Fault::overrun);
    EXPECT_EQ(watched.tick(), Fault::none) << "a tick in time ends the streak";
}

TEST(Watchdog, NamesOneLongGap) {
    Watched watched;
    watched.seen.missed_periods = 20;
    EXPECT_EQ(watched.tick(), Fault::overrun);
}

TEST(Watchdog, LetsSingleMissesPass) {
    Watched watched;
    for (int i = 0; i < 1000; ++i) {
        watched.seen.missed_periods = i % 2 == 0 ? 5 : 0;
        ASSERT_EQ(watched.tick(), Fault::none);
    }
}

}  // namespace
}  // namespace osteomill::watchdog_test
