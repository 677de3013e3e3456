// Rate limit: so many a second on average, and at once as many as were saved up. The caller passes the time.
#pragma once

#include <algorithm>
#include <chrono>

namespace osteomill {

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

}  // namespace osteomill
