// Waits for the work of another thread or process: until a condition holds, or it is far too late. No test
// measures how long something took: the machine may be busy with other things.
#pragma once

#include <chrono>
#include <thread>

namespace osteomill::testing {

/// A time that only a defect can take.
inline constexpr std::chrono::seconds far_too_long{120};

/// Is true from then on: whether to give up waiting.
inline auto far_too_late() {
    return [end = std::chrono::steady_clock::now() + far_too_long] {
        return std::chrono::steady_clock::now() > end;
    };
}

/// True as soon as `condition` holds; false after so long.
template <typename Condition>
bool eventually(Condition&& condition, std::chrono::seconds deadline = far_too_long) {
    const auto end = std::chrono::steady_clock::now() + deadline;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

}  // namespace osteomill::testing
