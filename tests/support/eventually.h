// Waits for what another thread does: until it is so, or far too late.
#pragma once

#include <chrono>
#include <thread>

namespace osteomill::testing {

/// True as soon as `condition` holds; false after a time that only a defect can take.
template <typename Condition>
bool eventually(Condition&& condition, std::chrono::seconds deadline = std::chrono::seconds(60)) {
    const auto end = std::chrono::steady_clock::now() + deadline;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

}  // namespace osteomill::testing
