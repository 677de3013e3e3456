#include "simulation/loop/clock.h"

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

RealClock::RealClock() noexcept : began_s_(seconds_of(CLOCK_BOOTTIME)) {}

double RealClock::now_s() const noexcept {
    return seconds_of(CLOCK_BOOTTIME) - began_s_;
}

void RealClock::sleep_until(double time_s) noexcept {
    const double left_s = time_s - now_s() - spin_s;
    if (left_s > 0.0) {
        const double wake_s = seconds_of(CLOCK_MONOTONIC) + left_s;
        const double whole_s = std::floor(wake_s);
        const timespec wake{static_cast<time_t>(whole_s), static_cast<long>(1e9 * (wake_s - whole_s))};
        // Interrupted by a signal it sleeps on: a request to stop goes to the loop, not to its clock.
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) != 0) {
        }
    }
    while (now_s() < time_s) {
    }
}

}  // namespace osteomill
