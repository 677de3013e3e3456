#include "haptic_server/loop/periodic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace osteomill {
namespace {

/// Wakes late by what the test says, tick by tick.
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

std::vector<Tick> run(Clock& clock, PeriodicStatistics& statistics, std::size_t count, double first_s = 0.0) {
    std::vector<Tick> ticks;
    const std::atomic<bool> stop{false};
    run_periodically(clock, 0.001, first_s, stop, statistics, [&](double time_s, std::uint64_t missed) {
        ticks.push_back({time_s, missed});
        return ticks.size() < count;
    });
    return ticks;
}

TEST(Periodic, RunsAtTheTimesOfItsSchedule) {
    VirtualClock clock;
    PeriodicStatistics statistics;
    const auto ticks = run(clock, statistics, 4, 0.5);
    ASSERT_EQ(ticks.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_DOUBLE_EQ(ticks[i].time_s, 0.5 + 0.001 * static_cast<double>(i));
        EXPECT_EQ(ticks[i].missed, 0u);
    }
    EXPECT_EQ(statistics.ticks, 4u);
    EXPECT_EQ(statistics.missed, 0u);
}

TEST(Periodic, KeepsItsScheduleWhenWokenALittleLate) {
    LateClock clock({0.0, 0.0004, 0.0});
    PeriodicStatistics statistics;
    const auto ticks = run(clock, statistics, 3);
    EXPECT_DOUBLE_EQ(ticks[1].time_s, 0.001);
    EXPECT_DOUBLE_EQ(ticks[2].time_s, 0.002);
    EXPECT_EQ(statistics.missed, 0u);
    EXPECT_NEAR(statistics.wakeup_latency.max_s(), 0.0004, 1e-9);
}

TEST(Periodic, SkipsAndCountsWhatItMissed) {
    LateClock clock({0.0, 0.0034, 0.0});
    PeriodicStatistics statistics;
    const auto ticks = run(clock, statistics, 3);
    EXPECT_EQ(ticks[1].missed, 3u);
    EXPECT_DOUBLE_EQ(ticks[1].time_s, 0.004);
    EXPECT_EQ(ticks[2].missed, 0u);
    EXPECT_DOUBLE_EQ(ticks[2].time_s, 0.005);
    EXPECT_EQ(statistics.missed, 3u);
    EXPECT_EQ(statistics.ticks, 3u);
}

TEST(Periodic, CountsTicksThatAreDoneAfterTheNextDeadline) {
    // Late by waking, late by working, and in time.
    LateClock clock({0.0, 0.0034, 0.0, 0.0, 0.0004});
    PeriodicStatistics statistics;
    int tick = 0;
    run_periodically(clock, 0.001, 0.0, std::atomic<bool>{false}, statistics, [&](double, std::uint64_t) {
        if (tick == 2) clock.work(0.0011);
        if (tick == 4) clock.work(0.0005);
        return ++tick < 5;
    });
    EXPECT_EQ(statistics.ticks, 5u);
    EXPECT_EQ(statistics.late, 2u);
}

TEST(Periodic, DoesNotStartAfterItWasToldToStop) {
    VirtualClock clock;
    PeriodicStatistics statistics;
    const std::atomic<bool> stop{true};
    run_periodically(clock, 0.001, 0.0, stop, statistics, [](double, std::uint64_t) {
        ADD_FAILURE();
        return false;
    });
    EXPECT_EQ(statistics.ticks, 0u);
}

}  // namespace
}  // namespace osteomill
