// Meaning of the one switch on a stylus: the pedal, or, if the profile lets it, the clutch. Pressed it is the
// pedal. Pressed twice within double_press_s and held it is the clutch, until it is let go.
#pragma once

#include "devices/hid/arm_profile.h"

namespace osteomill {

class StylusSwitch {
  public:
    /// From the first press to the second; a pedal that is let go and pressed again is slower.
    static constexpr double double_press_s = 0.3;

    explicit StylusSwitch(SwitchUse use) : use_(use) {}

    /// `now_s` never decreases. Real-time safe.
    void read(bool is_pressed, double now_s) noexcept {
        const bool goes_down = is_pressed && !was_pressed_;
        if (goes_down && use_ == SwitchUse::pedal_and_clutch)
            is_clutch_ = has_been_pressed_ && now_s - pressed_s_ <= double_press_s;
        if (goes_down) {
            pressed_s_ = now_s;
            has_been_pressed_ = true;
        }
        if (!is_pressed) is_clutch_ = false;
        was_pressed_ = is_pressed;
    }

    bool is_pedal() const { return was_pressed_ && !is_clutch_; }
    bool is_clutch() const { return is_clutch_; }

  private:
    SwitchUse use_;
    bool was_pressed_ = false;
    bool has_been_pressed_ = false;
    bool is_clutch_ = false;
    double pressed_s_ = 0.0;
};

}  // namespace osteomill
