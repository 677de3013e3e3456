#include <algorithm>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

#include "common/statistics/percentile.h"
#include "haptic_server/check/machine_check.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

using SteadyClock = std::chrono::steady_clock;

WakeUps wake_ups() {
    static constexpr int count = 500;
    static constexpr std::chrono::milliseconds period{1};
    std::vector<double> late_us;
    late_us.reserve(count);
    std::jthread([&late_us] {
        (void)ask_for_real_time(haptic_priority);
        SteadyClock::time_point due = SteadyClock::now();
        for (int i = 0; i < count; ++i) {
            due += period;
            std::this_thread::sleep_until(due);
            late_us.push_back(std::chrono::duration<double, std::micro>(SteadyClock::now() - due).count());
        }
    }).join();
    return {count, percentile(late_us, 0.99), *std::ranges::max_element(late_us)};
}

double clock_ns() {
    constexpr int reads = 10'000;
    const SteadyClock::time_point begin = SteadyClock::now();
    SteadyClock::time_point last;
    for (int i = 0; i < reads; ++i) last = SteadyClock::now();
    return std::chrono::duration<double, std::nano>(last - begin).count() / reads;
}

}  // namespace

CheckedMachine this_machine() {
    return {.program = std::filesystem::read_symlink("/proc/self/exe").string(),
            .rights = real_time_rights(),
            .measure_wake_ups = wake_ups,
            .measure_clock_ns = clock_ns};
}

}  // namespace osteomill
