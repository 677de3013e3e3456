// The held keys of a keyboard that may stutter: remote desktops repeat a held key as release and press. A key
// that returns within longest_gap_s counts as held throughout.
#pragma once

#include <bitset>
#include <map>

#include "render_client/ui/input/window_input.h"

namespace osteomill {

class HeldKeys {
  public:
    static constexpr double longest_gap_s = 0.04;

    // Times are of one clock, and do not decrease; keys are below WindowInput::most_keys.

    /// Whether this press takes the key down: not if it is down, or returns within the gap.
    bool press(std::size_t key, double now_s) {
        settle(now_s);
        released_s_.erase(key);
        const bool goes_down = !down_[key];
        down_.set(key);
        return goes_down;
    }
    void release(std::size_t key, double now_s) {
        if (down_[key]) released_s_.try_emplace(key, now_s);
    }
    /// Releases keys that were not repeated in time; returns whether there was any.
    bool settle(double now_s) {
        return std::erase_if(released_s_, [&](const auto& released) {
                   const bool is_up = now_s - released.second >= longest_gap_s;
                   if (is_up) down_.reset(released.first);
                   return is_up;
               }) > 0;
    }
    /// Some key may come back yet.
    bool is_settling() const { return !released_s_.empty(); }
    const std::bitset<WindowInput::most_keys>& down() const { return down_; }

  private:
    std::bitset<WindowInput::most_keys> down_;
    std::map<std::size_t, double> released_s_;  // keys that still count as down
};

}  // namespace osteomill
