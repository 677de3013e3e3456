// Lines that strangers cause, a few at a time: a scan of ports must not fill the disk, nor bury what matters.
#pragma once

#include <spdlog/spdlog.h>

#include <cstddef>
#include <string>
#include <utility>

#include "haptic_server/streaming/token_bucket.h"

namespace osteomill {

class LimitedLog {
  public:
    using Time = TokenBucket::Time;

    /// Enough for everybody to come and go at once; then a line every two seconds.
    static constexpr double lines_at_once = 40.0;
    static constexpr double lines_per_s = 0.5;

    void write(spdlog::level::level_enum level, const std::string& line, Time now) {
        if (!lines_.take(now)) {
            ++left_out_;
            return;
        }
        spdlog::log(level, "{}{}", line, count_left_out());
    }

    /// To be called regularly: what was left out of the log is counted in a line when there is room, though
    /// all is quiet.
    void tell_left_out(Time now) {
        if (left_out_ > 0 && lines_.take(now)) spdlog::warn("clients came and went{}", count_left_out());
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
