// The rule for when a frame is drawn: while the picture changes, and a little longer; if only figures change
// (the time, the delay of the link), once a second, or less often if a frame is expensive; otherwise never.
// No clock: the caller passes the time.
#pragma once

#include <algorithm>
#include <chrono>

namespace osteomill {

class Redraw {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Dear ImGui shows the effect of input a frame or two later, and the camera counts as resting only after
    /// two frames without motion. A frame of a slow machine may be longer than the time.
    static constexpr std::chrono::milliseconds settling{250};
    static constexpr int settling_frames = 4;
    /// Figures take at most a hundredth of the time, twice that of a core if two draw a frame; but they come
    /// every five seconds at the least.
    static constexpr int frames_between_figures = 100;
    static constexpr std::chrono::milliseconds shortest_figures_period{1000};
    static constexpr std::chrono::milliseconds longest_figures_period{5000};

    /// Something visible other than figures changes, or the window must be drawn again.
    void note_change(Time now) {
        changes_until_ = now + settling;
        frames_left_ = settling_frames;
    }
    void note_figures() { has_new_figures_ = true; }

    bool is_due(Time now) const {
        return now <= changes_until_ || frames_left_ > 0 ||
               (has_new_figures_ && now - drawn_ >= figures_period_);
    }
    /// A frame that was begun at `now` took so long.
    void drew(Time now, Time::duration took) {
        drawn_ = now;
        has_new_figures_ = false;
        frames_left_ = std::max(frames_left_ - 1, 0);
        figures_period_ = std::clamp<Time::duration>(frames_between_figures * took, shortest_figures_period,
                                                     longest_figures_period);
    }

  private:
    Time changes_until_{};
    int frames_left_ = 0;
    Time drawn_{};
    Time::duration figures_period_ = shortest_figures_period;
    bool has_new_figures_ = false;
};

}  // namespace osteomill
