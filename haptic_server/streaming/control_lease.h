// Lease on the controls (pause, undo, marks) of a session whose tool no client moves, such as one with an
// arm. The first client that uses a control has it until it leaves, or until it has used none for half a
// minute and another does. If a client moves the tool, the lease on the tool decides instead (tool_lease.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace osteomill {

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

}  // namespace osteomill
