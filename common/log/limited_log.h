// Log lines caused by strangers, limited in rate: a port scan must not fill the disk, nor bury important
// lines.
#pragma once

#include <spdlog/spdlog.h>

#include <cstddef>
#include <string>
#include <utility>

#include "common/log/token_bucket.h"

namespace osteomill {

class LimitedLog {
  public:
    using Time = TokenBucket::Time;

    /// Enough for all clients to come and go at once; then a line every two seconds.
    static constexpr double lines_at_once = 40.0;
    static constexpr double lines_per_s = 0.5;

    void write(spdlog::level::level_enum level, const std::string& line, Time now) {
        if (!lines_.take(now)) {
            ++left_out_;
            return;
        }
        spdlog::log(level, "{}{}", line, count_left_out());
    }

    /// Call regularly: when the limit allows, writes a line with the number of lines left out, even if no
    /// more come.
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
