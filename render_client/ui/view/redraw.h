// The rule for when a window draws, or a run without one: while what it shows changes, and a little longer;
// where nothing changes but figures (the time, the delay of the link), once a second, or less often where a
// frame is dear; else not at all. No clock: the caller says what time it is.
#pragma once

#include <algorithm>
#include <chrono>

namespace osteomill {

class Redraw {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Dear ImGui shows a frame or two later what an input did, and the camera is known to rest only after
    /// two frames without motion.
    static constexpr std::chrono::milliseconds settling{250};
    /// Figures take at most a hundredth of the time, twice that of a core where two draw a frame; but they
    /// come every five seconds at the least.
    static constexpr int frames_between_figures = 100;
    static constexpr std::chrono::milliseconds shortest_figures_period{1000};
    static constexpr std::chrono::milliseconds longest_figures_period{5000};

    /// What is shown changes otherwise than in figures, or is to be shown anew.
    void note_change(Time now) { changes_until_ = now + settling; }
    void note_figures() { has_new_figures_ = true; }

    bool is_due(Time now) const {
        return now <= changes_until_ || (has_new_figures_ && now - drawn_ >= figures_period_);
    }
    /// A frame that was begun at `now` took so long.
    void drew(Time now, Time::duration took) {
        drawn_ = now;
        has_new_figures_ = false;
        figures_period_ = std::clamp<Time::duration>(frames_between_figures * took, shortest_figures_period,
                                                     longest_figures_period);
    }

  private:
    Time changes_until_{};
    Time drawn_{};
    Time::duration figures_period_ = shortest_figures_period;
    bool has_new_figures_ = false;
};

}  // namespace osteomill
