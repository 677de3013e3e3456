// Which client drives the device, and what it wants: the first that sends input, until it leaves or its lease
// runs out. Its input renews the lease; but one that brings nothing new for half a minute, see
// OperatorActivity, gives the seat to the next who asks.
// That a silent operator's pedal comes up is not for the seat to see to: the device does, see
// haptic_server/device/permission.h.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "common/wire/tool_view.h"
#include "haptic_server/exchange/operator_input.h"
#include "haptic_server/exchange/triple_buffer.h"
#include "haptic_server/streaming/operator_activity.h"

namespace osteomill {

class OperatorSeat {
  public:
    using Time = std::chrono::steady_clock::time_point;
    using ClientId = std::uint64_t;

    /// So long after its last input the seat is the next one's. Long enough to reconnect after a hiccup of
    /// the network, short enough for a colleague who waits.
    static constexpr std::chrono::milliseconds lease{3000};

    /// The seat is the one writer of `output`.
    explicit OperatorSeat(TripleBuffer<OperatorInput>& output) : output_(output) {}

    /// Input from a client, already checked. Ignored unless the seat is free or its own; false if ignored.
    bool take_input(ClientId client, const OperatorIntent& intent, Time now);
    /// A client has gone; the seat is free if it was that client's.
    void leave(ClientId client);
    /// Nobody drives any more.
    void vacate();
    /// To be called regularly.
    void check_silence(Time now);
    /// Who has it, for the log.
    std::optional<ClientId> holder() const { return holder_; }
    /// What a client is to be told, as of the last call of any of the above.
    ToolDriver driver_for(ClientId client) const;

  private:
    /// Whether the holder may keep it though another asks.
    bool is_kept(Time now) const { return now - last_heard_ <= lease && !activity_.is_idle(now); }
    void publish(bool present);

    TripleBuffer<OperatorInput>& output_;
    std::optional<ClientId> holder_;
    OperatorActivity activity_;  // of the holder
    Time last_heard_{};
    OperatorInput input_;
};

}  // namespace osteomill
