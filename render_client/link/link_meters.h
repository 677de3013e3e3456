// Meters of the link: the rate at which a counter grows, and the age of the picture.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

namespace osteomill {

/// Age of a client's picture, from the server's stamps.
///
/// A stamp is the server's wall clock. On one machine the measured delay is right; between two it is off by
/// as much as their clocks are, and may be negative. Its excess over the least of this session is right if
/// the clocks run at the same rate, but leaves out the delay that every frame has.
class DelayMeter {
  public:
    struct Delay {
        double by_clocks_s = 0.0;
        double over_least_s = 0.0;
    };

    /// `stamp_unix_ns` came from the server: any number.
    Delay update(std::int64_t stamp_unix_ns, std::chrono::system_clock::time_point now) {
        const double now_s = std::chrono::duration<double>(now.time_since_epoch()).count();
        const double delay_s = now_s - 1e-9 * static_cast<double>(stamp_unix_ns);
        least_s_ = std::min(least_s_, delay_s);
        return {delay_s, delay_s - least_s_};
    }

  private:
    double least_s_ = std::numeric_limits<double>::infinity();
};

/// Rate at which a counter grows, over windows of one second.
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
