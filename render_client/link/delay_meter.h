// Age of a client's picture, from the server's stamps.
//
// A stamp is the server's wall clock. On one machine the measured delay is right; between two it is off by as
// much as their clocks are, and may be negative. Its excess over the least of this session is right if the
// clocks run at the same rate, but leaves out the delay that every frame has.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

namespace osteomill {

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

}  // namespace osteomill
