// Activity of the client that moves the tool: whether it uses the tool, or only keeps its lease.
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

    /// Input of the client that has the lease. Activity is a new target, axis or burr, or a pedal that is
    /// down.
    void note(const OperatorCommand& command, Time now) {
        if (!newest_ || command.pedal || *newest_ != command) acted_ = now;
        newest_ = command;
    }

    /// Whether the client has been inactive for so long that another may take the tool.
    bool is_idle(Time now) const { return newest_ && now - acted_ > longest_rest; }

  private:
    std::optional<OperatorCommand> newest_;
    Time acted_{};
};

}  // namespace osteomill
