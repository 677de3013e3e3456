// Runs work at a fixed rate on a clock, and measures how well that went.
#pragma once

#include <atomic>
#include <cstdint>

#include "haptic_server/loop/clock.h"
#include "haptic_server/loop/histogram.h"

namespace osteomill {

struct PeriodicStatistics {
    std::uint64_t ticks = 0;   ///< that were run
    std::uint64_t missed = 0;  ///< deadlines that had passed when the next tick's wake-up came
    std::uint64_t late = 0;    ///< ticks whose work was done a period or more after their deadline
    Histogram wakeup_latency;  ///< from the deadline to the start of the work
    Histogram duration;        ///< of the work
};

/// Calls `work(time_s, missed_periods)` at first_s, first_s + period_s, ... until `stop` is set or work
/// returns false. `time_s` is the time that the schedule gives, not the one at which the thread woke. A tick
/// that comes a whole period late or more does not run after those it missed: they are skipped, counted and
/// handed to it. Real-time safe if clock and work are.
template <typename Work>
void run_periodically(Clock& clock, double period_s, double first_s, const std::atomic<bool>& stop,
                      PeriodicStatistics& statistics, Work&& work) {
    for (std::uint64_t tick = 0; !stop.load(std::memory_order_relaxed); ++tick) {
        double deadline_s = first_s + static_cast<double>(tick) * period_s;
        clock.sleep_until(deadline_s);
        const double woke_s = clock.now_s();
        statistics.wakeup_latency.add(woke_s - deadline_s);
        const double late_from_s = deadline_s + period_s;

        std::uint64_t missed = 0;
        if (woke_s - deadline_s >= period_s) {
            missed = static_cast<std::uint64_t>((woke_s - deadline_s) / period_s);
            tick += missed;
            deadline_s = first_s + static_cast<double>(tick) * period_s;
        }
        statistics.missed += missed;
        ++statistics.ticks;
        const bool go_on = work(deadline_s, missed);
        const double done_s = clock.now_s();
        statistics.duration.add(done_s - woke_s);
        if (done_s >= late_from_s) ++statistics.late;
        if (!go_on) return;
    }
}

}  // namespace osteomill
