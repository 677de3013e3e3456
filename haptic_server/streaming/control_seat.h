// Lease on the controls of a session whose tool none of them moves, such as one with an arm: the
// first who does something, until it leaves or has rested for half a minute. Where a client moves the tool
// the lease on that decides instead (control_lease.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace osteomill {

class ControlSeat {
  public:
    using Time = std::chrono::steady_clock::time_point;
    using ClientId = std::uint64_t;

    static constexpr std::chrono::seconds longest_rest{30};

    bool is_open_to(ClientId client, Time now) const {
        return !holder_ || *holder_ == client || now - used_ > longest_rest;
    }
    /// Call only if it is open to the client.
    void use(ClientId client, Time now) {
        holder_ = client;
        used_ = now;
    }
    /// Who used it last and has not left.
    std::optional<ClientId> holder() const { return holder_; }
    void leave(ClientId client) {
        if (holder_ == client) holder_.reset();
    }

  private:
    std::optional<ClientId> holder_;
    Time used_{};
};

}  // namespace osteomill
