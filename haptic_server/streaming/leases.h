// Leases on a session's tool and on its controls: the one client that has it, its newest input, and log
// lines when that changes.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/session/operator_command.h"
#include "common/session/tool_state.h"
#include "simulation/exchange/operator_channel.h"

namespace osteomill {

/// Lease on the controls (pause, undo, marks) of a session whose tool no client moves, such as one with an
/// arm. The first client that uses a control has it until it leaves, or until it has used none for half a
/// minute and another does. If a client moves the tool, the lease on the tool decides instead.
class ControlLease {
  public:
    using Time = std::chrono::steady_clock::time_point;
    using ClientId = std::uint64_t;

    /// Long enough to inspect one's milling, short enough for a colleague who waits.
    static constexpr std::chrono::seconds longest_rest{30};

    bool is_open_to(ClientId client, Time now) const {
        return !holder_ || *holder_ == client || now - used_ > longest_rest;
    }
    /// Call only if it is open to the client.
    void use(ClientId client, Time now) {
        holder_ = client;
        used_ = now;
    }
    /// The client that used it last and has not left.
    std::optional<ClientId> holder() const { return holder_; }
    void leave(ClientId client) {
        if (holder_ == client) holder_.reset();
    }

  private:
    std::optional<ClientId> holder_;
    Time used_{};
};

/// Lease on the tool: the client that moves it, and that client's newest input. The first client that sends
/// input has the lease until it leaves or the lease runs out. Its input renews the lease. A client whose
/// input has not changed for half a minute, its pedal up, loses it to the next one that sends input. The
/// pedal of a silent operator is the device's matter, see simulation/device/permission.h.
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
    std::uint64_t releases_ = 0;  // of the pedal
    Time acted_{};                // a new target, axis or burr, or the pedal was down
    Time last_heard_{};
};

/// Log lines about changes of the client that moves the tool.
class LeaseHistory {
  public:
    /// A line for the client that has let go since the last call, then one for the client that has the tool
    /// now; none if nothing changed. `peer_of` gives the name of a client that is connected.
    template <typename PeerOf>
    std::vector<std::string> update(std::optional<ToolLease::ClientId> holder, PeerOf&& peer_of) {
        std::vector<std::string> lines;
        if (holder == holder_) return lines;
        if (holder_) lines.push_back(fmt::format("client {} no longer moves the tool", peer_));
        if (holder) peer_ = peer_of(*holder);
        if (holder) lines.push_back(fmt::format("client {} moves the tool", peer_));
        holder_ = holder;
        return lines;
    }

  private:
    std::optional<ToolLease::ClientId> holder_;
    std::string peer_;  // that client's address; it may have gone
};

}  // namespace osteomill
