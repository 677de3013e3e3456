#include "studies/render/full_rate/finished_frames.h"

#include <chrono>
#include <ctime>
#include <optional>

namespace osteomill::study {

namespace {

using Clock = std::chrono::steady_clock;

double cpu_now_ms() {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void FrameStopwatch::time(const std::function<void()>& work) {
    const double cpu_before_ms = cpu_now_ms();
    const Clock::time_point start = Clock::now();
    timer_.start();
    work();
    timer_.stop();
    frames_.wall.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    frames_.cpu.push_back(cpu_now_ms() - cpu_before_ms);
    std::optional<double> took_s = timer_.take_s();
    while (!took_s) took_s = timer_.take_s();
    frames_.gpu.push_back(1e3 * *took_s);
}

}  // namespace osteomill::study
