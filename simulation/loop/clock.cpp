#include "simulation/loop/clock.h"

#include <cerrno>
#include <cmath>
#include <ctime>

namespace osteomill {

namespace {

double seconds_of(clockid_t clock) noexcept {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double RealClock::boot_time_s() noexcept {
    return seconds_of(CLOCK_BOOTTIME);
}

RealClock::RealClock(double (*system_s)() noexcept) noexcept : system_s_(system_s), began_s_(system_s()) {}

double RealClock::now_s() const noexcept {
    double began_s = began_s_.load(std::memory_order_relaxed);
    const double now_s = system_s_() - began_s;
    const double latest_s = latest_s_.load(std::memory_order_relaxed);
    if (now_s >= latest_s) {
        latest_s_.store(now_s, std::memory_order_relaxed);
        return now_s;
    }
    // If two threads find it so, only one moves the beginning.
    if (latest_s - now_s > least_step_back_s)
        began_s_.compare_exchange_strong(began_s, began_s - (latest_s - now_s), std::memory_order_relaxed);
    return latest_s;
}

void RealClock::sleep_until(double time_s) noexcept {
    const double left_s = time_s - now_s() - spin_s;
    if (left_s > 0.0) {
        const double wake_s = seconds_of(CLOCK_MONOTONIC) + left_s;
        const double whole_s = std::floor(wake_s);
        const timespec wake{static_cast<time_t>(whole_s), static_cast<long>(1e9 * (wake_s - whole_s))};
        // Interrupted by a signal it sleeps on: a request to stop goes to the loop, not to its clock. If it
        // cannot sleep, it spins.
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
        }
    }
    while (now_s() < time_s) {
    }
}

}  // namespace osteomill
