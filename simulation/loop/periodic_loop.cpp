#include "simulation/loop/periodic_loop.h"

#include <utility>

namespace osteomill {

PeriodicLoop::PeriodicLoop(double period_s, double first_s, Work work)
    : period_s_(period_s), first_s_(first_s), work_(std::move(work)) {}

void PeriodicLoop::wait_and_tick(Clock& clock) noexcept {
    const double deadline_s = due_s();
    clock.sleep_until(deadline_s);
    const double late_s = clock.now_s() - deadline_s;
    statistics_.wakeup_latency.add(late_s);
    tick(late_s >= period_s_ ? static_cast<std::uint64_t>(late_s / period_s_) : 0, clock);
    if (clock.now_s() >= deadline_s + period_s_) ++statistics_.late;
}

void PeriodicLoop::tick(std::uint64_t missed, const Clock& stopwatch) noexcept {
    next_ += missed;
    const double began_s = stopwatch.now_s();
    work_(due_s(), missed);
    statistics_.duration.add(stopwatch.now_s() - began_s);
    statistics_.missed += missed;
    ++statistics_.ticks;
    ++next_;
}

}  // namespace osteomill
