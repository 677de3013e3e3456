// Rate at which a counter grows, over windows of one second.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace osteomill {

class RateMeter {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Growth per second over the last full window; zero before the first is full.
    double update(std::uint64_t count, Time now) {
        if (!window_began_) {
            window_began_ = now;
            count_at_begin_ = count;
        }
        const std::chrono::duration<double> elapsed = now - *window_began_;
        if (elapsed.count() >= 1.0) {
            per_s_ = static_cast<double>(count - count_at_begin_) / elapsed.count();
            window_began_ = now;
            count_at_begin_ = count;
        }
        return per_s_;
    }

  private:
    std::optional<Time> window_began_;
    std::uint64_t count_at_begin_ = 0;
    double per_s_ = 0.0;
};

}  // namespace osteomill
