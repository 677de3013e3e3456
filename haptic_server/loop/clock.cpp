#include "haptic_server/loop/clock.h"

#include <cmath>
#include <ctime>

namespace osteomill {

namespace {

double monotonic_s() noexcept {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

RealClock::RealClock() noexcept : began_s_(monotonic_s()) {}

double RealClock::now_s() const noexcept {
    return monotonic_s() - began_s_;
}

void RealClock::sleep_until(double time_s) noexcept {
    const double wake_s = began_s_ + time_s - spin_s;
    if (wake_s > monotonic_s()) {
        const double whole_s = std::floor(wake_s);
        const timespec wake{static_cast<time_t>(whole_s), static_cast<long>(1e9 * (wake_s - whole_s))};
        // Interrupted by a signal it sleeps on: whoever wants to stop says so to the loop, not to its clock.
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) != 0) {
        }
    }
    while (now_s() < time_s) {
    }
}

}  // namespace osteomill
