// The span of a stroke, which undo gives back slice by slice, and which the report counts.
//
// A stroke begins when the turning burr touches bone. It ends when the pedal comes up and no more bone goes,
// or when the burr has been clear of bone for longest_gap_s: a tool is lifted and set down again within one
// stroke, as a pen is.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

namespace osteomill {

class StrokeSpan {
  public:
    static constexpr double longest_gap_s = 0.5;

    /// Once a frame: whether a stroke is under way. `now_s`: session time; `takes_bone`: in this frame, which
    /// the milling loop may do a step after the pedal came up; `feels_bone`: there is a force on the hand.
    bool goes_on(double now_s, bool spindle_on, bool takes_bone, bool feels_bone) {
        touches_ = takes_bone || (spindle_on && feels_bone);
        if (touches_) touched_s_ = now_s;
        if (!touches_ && !spindle_on) touched_s_.reset();
        if (touched_s_ && now_s - *touched_s_ >= longest_gap_s) touched_s_.reset();
        return touched_s_.has_value();
    }
    /// In the last frame.
    bool touches() const { return touches_; }

  private:
    bool touches_ = false;
    std::optional<double> touched_s_;  // the last time, of a stroke under way
};

/// The slice of a stroke that one undo gives back. A stroke may last a minute. A slice ends with its stroke,
/// and once it has cut for longest_cut_s, so that one key press never takes back more.
/// Kept in haptic_server/streaming/stroke_journal.h.
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
