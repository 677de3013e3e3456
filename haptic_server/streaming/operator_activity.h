// Whether the one who moves the tool does anything with it, or only keeps its lease.
#pragma once

#include <chrono>
#include <optional>

#include "common/scene/tool_state.h"

namespace osteomill {

class OperatorActivity {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Long enough to look at what one has milled, short enough for a colleague who waits.
    static constexpr std::chrono::seconds longest_rest{30};

    /// Another takes the lease.
    void begin() { newest_.reset(); }

    /// What came of the one who has the lease. Anything new is an act: the target, the axis, the burr; and a
    /// pedal that is down.
    void note(const OperatorIntent& intent, Time now) {
        if (!newest_ || intent.pedal || !is_same(*newest_, intent)) acted_ = now;
        newest_ = intent;
    }

    /// Whether nothing new has come for so long that it must not keep the tool from another.
    bool is_idle(Time now) const { return newest_ && now - acted_ > longest_rest; }

  private:
    static bool is_same(const OperatorIntent& a, const OperatorIntent& b) {
        return a.hand_target_mm == b.hand_target_mm && a.spindle_axis == b.spindle_axis &&
               a.pedal == b.pedal && a.burr == b.burr;
    }

    std::optional<OperatorIntent> newest_;
    Time acted_{};
};

}  // namespace osteomill
