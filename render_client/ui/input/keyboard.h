// A keyboard: the keys that are held though it may stutter, and the key that a person means.
#pragma once

#include <bitset>
#include <map>
#include <string_view>

#include "render_client/ui/input/window_input.h"

namespace osteomill {

/// The held keys of a keyboard that may stutter: remote desktops repeat a held key as release and press. A
/// key that returns within longest_gap_s counts as held throughout.
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

// The key that a person means: a letter or sign means the key that bears it, wherever the layout has it.

/// `key`: GLFW's number, the place on a US keyboard; `printed`: the sign that the layout in use writes there
/// without shift (glfwGetKeyName), empty if there is none. Returns GLFW's number of the key that is meant:
/// the row of digits stays that, because its keys bear digits on every layout; a letter of another alphabet
/// stands for the Latin one at its place; a sign that has no meaning here is no key (-1).
int meant_key(int key, std::string_view printed);

}  // namespace osteomill
