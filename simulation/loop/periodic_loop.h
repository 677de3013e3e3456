// A loop that ticks at a fixed rate: its schedule, its work, and its measured timing. It waits on its own
// clock, or ticks one by one for a caller that keeps the order, as on the virtual clock.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "simulation/loop/clock.h"
#include "simulation/loop/histogram.h"

namespace osteomill {

struct PeriodicStatistics {
    std::uint64_t ticks = 0;   ///< that were run
    std::uint64_t missed = 0;  ///< deadlines that had passed when the next tick's wake-up came
    std::uint64_t late = 0;    ///< ticks whose work was done a period or more after their deadline
    Histogram wakeup_latency;  ///< from the deadline to the start of the work
    Histogram duration;        ///< the work's
};

/// One thread. Ticks are real-time safe if the clock and the work are.
class PeriodicLoop {
  public:
    /// A tick's work. `time_s` is the time that the schedule gives, not the one at which the thread woke.
    using Work = std::function<void(double time_s, std::uint64_t missed_periods)>;

    /// Ticks are due at first_s, first_s + period_s, ...
    PeriodicLoop(double period_s, double first_s, Work work);
    /// At the place of another's schedule, with other work.
    PeriodicLoop(const PeriodicLoop& other, Work work) : PeriodicLoop(other) { work_ = std::move(work); }

    /// When the next tick is due.
    double due_s() const noexcept { return first_s_ + static_cast<double>(next_) * period_s_; }

    /// Waits until the next tick is due, and runs it. If it is a whole period late or more, the missed ticks
    /// are not run: they are skipped, counted, and their number is passed to it.
    void wait_and_tick(Clock& clock) noexcept;
    /// Runs the next tick at once, as one that is in time. `stopwatch` only measures how long its work takes.
    void tick_now(const Clock& stopwatch) noexcept { tick(0, stopwatch); }
    /// The same behind so many that are skipped: for a session of the real clock that is repeated.
    void tick_after(std::uint64_t missed, const Clock& stopwatch) noexcept { tick(missed, stopwatch); }

    const PeriodicStatistics& statistics() const { return statistics_; }

  private:
    void tick(std::uint64_t missed, const Clock& stopwatch) noexcept;

    double period_s_;
    double first_s_;
    Work work_;
    std::uint64_t next_ = 0;  // number of the next tick, those skipped included
    PeriodicStatistics statistics_;
};

}  // namespace osteomill
