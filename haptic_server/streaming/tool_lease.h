// Lease on the tool: the client that moves it, and that client's newest input. The first client that sends
// input has the lease until it leaves or the lease runs out. Its input renews the lease. A client whose input
// has not changed for half a minute, its pedal up, loses it to the next one that sends input. The pedal
// of a silent operator is the device's matter, see simulation/device/permission.h.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "common/session/operator_command.h"
#include "common/session/tool_state.h"
#include "haptic_server/streaming/control_lease.h"
#include "simulation/exchange/operator_channel.h"

namespace osteomill {

class ToolLease {
  public:
    using Time = std::chrono::steady_clock::time_point;
    using ClientId = std::uint64_t;

    /// From the last input to the end of the lease: long enough to reconnect after a hiccup of the network,
    /// short enough for a colleague who waits.
    static constexpr std::chrono::milliseconds duration{3000};

    /// The lease is the one writer of `output`.
    explicit ToolLease(OperatorChannel& output) : output_(output) {}

    /// Input from a client, already checked. Ignored unless the tool is free or its own; false if ignored.
    bool take_input(ClientId client, const OperatorCommand& command, Time now);
    /// A client has gone; the tool is free if it was that client's.
    void leave(ClientId client);
    /// Nobody moves it any more.
    void end();
    /// To be called regularly.
    void check_silence(Time now);
    /// Who has it, for the log.
    std::optional<ClientId> holder() const { return holder_; }
    /// The state to send a client, as of the last call of any of the above.
    ToolDriver driver_for(ClientId client) const;

  private:
    /// Whether the holder may keep it though another asks.
    bool is_kept(Time now) const {
        return now - last_heard_ <= duration && now - acted_ <= ControlLease::longest_rest;
    }

    OperatorChannel& output_;
    std::optional<ClientId> holder_;
    // The holder's:
    std::optional<OperatorCommand> newest_;
    Time acted_{};  // a new target, axis or burr, or the pedal was down
    Time last_heard_{};
};

}  // namespace osteomill
