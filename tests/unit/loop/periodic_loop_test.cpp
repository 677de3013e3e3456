#include "simulation/loop/periodic_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace osteomill {
namespace {

/// Wakes late by the test's delays, tick by tick.
class LateClock final : public Clock {
  public:
    explicit LateClock(std::vector<double> late_s) : late_s_(std::move(late_s)) {}
    double now_s() const noexcept override { return now_s_; }
    void sleep_until(double time_s) noexcept override {
        const double late_s = sleeps_ < late_s_.size() ? late_s_[sleeps_] : 0.0;
        ++sleeps_;
        now_s_ = std::max(now_s_, time_s) + late_s;
    }

    void work(double duration_s) { now_s_ += duration_s; }

  private:
    std::vector<double> late_s_;
    std::size_t sleeps_ = 0;
    double now_s_ = 0.0;
};

struct Tick {
    double time_s;
    std::uint64_t missed;
};

/// A loop of 1 kHz that records its ticks.
struct Noted {
    std::vector<Tick> ticks;
    PeriodicLoop loop;

    explicit Noted(double first_s = 0.0)
        : loop(0.001, first_s, [this](double time_s, std::uint64_t missed) {
              ticks.push_back({time_s, missed});
          }) {}
    void run(Clock& clock, int count) {
        for (int i = 0; i < count; ++i) loop.wait_and_tick(clock);
    }
};

TEST(PeriodicLoop, TicksAtTheTimesOfItsSchedule) {
    LateClock clock({});
    Noted noted(0.5);
    noted.run(clock, 4);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_DOUBLE_EQ(noted.ticks[i].time_s, 0.5 + 0.001 * static_cast<double>(i));
        EXPECT_EQ(noted.ticks[i].missed, 0u);
    }
    EXPECT_DOUBLE_EQ(clock.now_s(), 0.503);
    EXPECT_DOUBLE_EQ(noted.loop.due_s(), 0.504);
    EXPECT_EQ(noted.loop.statistics().ticks, 4u);
    EXPECT_EQ(noted.loop.statistics().missed, 0u);
}

TEST(PeriodicLoop, KeepsItsScheduleWhenWokenALittleLate) {
    LateClock clock({0.0, 0.0004, 0.0});
    Noted noted;
    noted.run(clock, 3);
    EXPECT_DOUBLE_EQ(noted.ticks[1].time_s, 0.001);
    EXPECT_DOUBLE_EQ(noted.ticks[2].time_s, 0.002);
    EXPECT_EQ(noted.loop.statistics().missed, 0u);
    EXPECT_NEAR(noted.loop.statistics().wakeup_latency.max_s(), 0.0004, 1e-9);
}

TEST(PeriodicLoop, SkipsAndCountsWhatItMissed) {
    LateClock clock({0.0, 0.0034, 0.0});
    Noted noted;
    noted.run(clock, 3);
    EXPECT_EQ(noted.ticks[1].missed, 3u);
    EXPECT_DOUBLE_EQ(noted.ticks[1].time_s, 0.004);
    EXPECT_EQ(noted.ticks[2].missed, 0u);
    EXPECT_DOUBLE_EQ(noted.ticks[2].time_s, 0.005);
    EXPECT_EQ(noted.loop.statistics().missed, 3u);
    EXPECT_EQ(noted.loop.statistics().ticks, 3u);
}

TEST(PeriodicLoop, CountsTicksThatAreDoneAfterTheNextDeadline) {
    // Late by waking, late by working, and in time.
    LateClock clock({0.0, 0.0034, 0.0, 0.0, 0.0004});
    int tick = 0;
    PeriodicLoop loop(0.001, 0.0, [&](double, std::uint64_t) {
        if (tick == 2) clock.work(0.0011);
        if (tick == 4) clock.work(0.0005);
        ++tick;
    });
    for (int i = 0; i < 5; ++i) loop.wait_and_tick(clock);
    EXPECT_EQ(loop.statistics().ticks, 5u);
    EXPECT_EQ(loop.statistics().late, 2u);
}

TEST(PeriodicLoop, TicksAtOnceForACallerWhoKeepsTheOrder) {
    LateClock stopwatch({});
    stopwatch.work(70.0);  // its reading does not matter
    Noted noted(0.5);
    noted.loop.tick_now(stopwatch);
    noted.loop.tick_now(stopwatch);
    EXPECT_DOUBLE_EQ(noted.ticks[1].time_s, 0.501);
    EXPECT_EQ(noted.ticks[1].missed, 0u);
    EXPECT_EQ(stopwatch.now_s(), 70.0) << "nobody waited";
    EXPECT_EQ(noted.loop.statistics().ticks, 2u);
    EXPECT_EQ(noted.loop.statistics().late, 0u);
}

}  // namespace
}  // namespace osteomill
