// The slice of a stroke that one undo gives back.
//
// A stroke (stroke_span.h) lasts as long as the pedal is down and the burr at the bone, which may be a
// minute. A slice ends with its stroke, and once it has cut for longest_cut_s, so that one key press never
// takes back more.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

namespace osteomill {

class UndoSlice {
  public:
    static constexpr double longest_cut_s = 3.0;

    /// Once a frame, after StrokeSpan: whether the slice ends with this frame.
    bool ends(double now_s, bool stroke_goes_on, bool takes_bone) {
        const double frame_s = std::max(0.0, now_s - std::exchange(before_s_, now_s).value_or(now_s));
        if (stroke_goes_on && takes_bone) cut_s_ += frame_s;
        const bool is_over = !stroke_goes_on || cut_s_ >= longest_cut_s;
        if (is_over) cut_s_ = 0.0;
        return is_over;
    }

  private:
    std::optional<double> before_s_;
    double cut_s_ = 0.0;
};

}  // namespace osteomill
