// When a window draws: while what it shows changes, and a little longer; where nothing changes but figures
// (the time, the delay of the link), once a second; else not at all. No clock: the caller says what time it
// is.
#pragma once

#include <chrono>

namespace osteomill {

class Redraw {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Dear ImGui shows a frame or two later what an input did, and the camera is known to rest only after
    /// two frames without motion.
    static constexpr std::chrono::milliseconds settling{250};
    static constexpr std::chrono::milliseconds figures_period{1000};

    /// What is shown changes otherwise than in figures, or is to be shown anew.
    void note_change(Time now) { changes_until_ = now + settling; }
    void note_figures() { has_new_figures_ = true; }

    bool is_due(Time now) const {
        return now <= changes_until_ || (has_new_figures_ && now - drawn_ >= figures_period);
    }
    void drew(Time now) {
        drawn_ = now;
        has_new_figures_ = false;
    }

  private:
    Time changes_until_{};
    Time drawn_{};
    bool has_new_figures_ = false;
};

}  // namespace osteomill
