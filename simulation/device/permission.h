// Permission to act on a message, as the haptic tick sees it: valid for a fixed time after the newest
// message, by the tick's own clock. It expires by itself; no network thread, log or other program has to be
// alive.
#pragma once

#include <algorithm>

namespace osteomill {

/// Session time, at `now_s`, of a message of age `age_s`; a negative age counts as zero.
constexpr double said_at(double now_s, double age_s) noexcept {
    return now_s - std::max(0.0, age_s);
}

class Permission {
  public:
    /// For messages from a network, or from a thread that may hang. At 50 messages a second nine in a row may
    /// be lost; and a spindle stops within a quarter of a second of the last one, including its delay.
    static constexpr double by_message_s = 0.2;

    /// Not given yet; lasts for `lasts_s` (session time) after each renewal.
    explicit constexpr Permission(double lasts_s = by_message_s) : lasts_s_(lasts_s) {}

    /// The permission as given at `said_s` (session time): the time of giving, not of reading. These are
    /// real-time safe.
    void renew(double said_s) noexcept {
        is_given_ = true;
        renewed_s_ = said_s;
    }
    void withdraw() noexcept { is_given_ = false; }
    /// Also false if the time is no number.
    bool holds(double now_s) const noexcept { return is_given_ && now_s - renewed_s_ <= lasts_s_; }
    double renewed_s() const noexcept { return renewed_s_; }

  private:
    double lasts_s_;
    double renewed_s_ = 0.0;
    bool is_given_ = false;
};

}  // namespace osteomill
