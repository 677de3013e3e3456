// The pedal of an operator who means to drill: down, but lifted for a moment once the spindle has stood for a
// while, for instance after a pause of a busy machine. A pedal that was never up turns nothing.
#pragma once

#include <chrono>

namespace osteomill::testing {

class HeldPedal {
  public:
    /// Once for each message.
    bool is_down(bool spindle_on) {
        const auto now = std::chrono::steady_clock::now();
        const bool is_lifted = !spindle_on && now > turned_ + std::chrono::milliseconds(300);
        if (spindle_on || is_lifted) turned_ = now;
        return !is_lifted;
    }

  private:
    std::chrono::steady_clock::time_point turned_{};  // the first message finds it up
};

}  // namespace osteomill::testing
