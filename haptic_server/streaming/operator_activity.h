// Activity of the one who moves the tool: whether anything is done with it, or only keeps its lease.
#pragma once

#include <chrono>
#include <optional>

#include "common/scene/operator_command.h"

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
    void note(const OperatorCommand& command, Time now) {
        if (!newest_ || command.pedal || *newest_ != command) acted_ = now;
        newest_ = command;
    }

    /// Whether nothing new has come for so long that it must not keep the tool from another.
    bool is_idle(Time now) const { return newest_ && now - acted_ > longest_rest; }

  private:
    std::optional<OperatorCommand> newest_;
    Time acted_{};
};

}  // namespace osteomill
