// Limits on what untrusted peers cause: a rate, and log lines at a limited rate, since a port scan must not
// fill the disk, nor bury important lines.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

#include "common/log/log.h"

namespace osteomill {

/// Rate limit: so many a second on average, and at once as many as were saved up. The caller passes the time.
class TokenBucket {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Full at first. `most` is its capacity, at least 1.
    TokenBucket(double per_s, double most) : per_s_(per_s), most_(most), tokens_(most) {}

    /// False if there is none left.
    bool take(Time now) {
        tokens_ = std::min(most_, tokens_ + per_s_ * std::chrono::duration<double>(now - filled_).count());
        filled_ = now;
        if (tokens_ < 1.0) return false;
        tokens_ -= 1.0;
        return true;
    }

  private:
    double per_s_;
    double most_;
    double tokens_;
    Time filled_{};
};

/// Log lines caused by untrusted peers, limited in rate: a port scan must not fill the disk, nor bury
/// important lines.
class LimitedLog {
  public:
    using Time = TokenBucket::Time;

    /// Enough for all clients to come and go at once; then a line every two seconds.
    static constexpr double lines_at_once = 40.0;
    static constexpr double lines_per_s = 0.5;

    void write(LogLevel level, const std::string& line, Time now) {
        if (!lines_.take(now)) {
            ++left_out_;
            return;
        }
        log_line(level, line + count_left_out());
    }

    /// Call regularly: when the limit allows, writes a line with the number of lines left out, even if no
    /// more come.
    void tell_left_out(Time now) {
        if (left_out_ > 0 && lines_.take(now)) log_warning("clients came and went{}", count_left_out());
    }

  private:
    std::string count_left_out() {
        if (left_out_ == 0) return {};
        return fmt::format(" (before it {} lines like this were left out)", std::exchange(left_out_, 0));
    }

    TokenBucket lines_{lines_per_s, lines_at_once};
    std::size_t left_out_ = 0;
};

}  // namespace osteomill
