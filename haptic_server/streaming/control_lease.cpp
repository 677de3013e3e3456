#include "haptic_server/streaming/control_lease.h"

namespace osteomill {

bool ControlLease::take_input(ClientId client, const OperatorCommand& command, Time now) {
    if (holder_ && *holder_ != client && is_kept(now)) return false;
    if (holder_ != client) activity_.begin();
    activity_.note(command, now);
    holder_ = client;
    last_heard_ = now;
    output_.back() = {command, now, client};
    output_.publish();
    return true;
}

void ControlLease::leave(ClientId client) {
    if (holder_ == client) end();
}

void ControlLease::end() {
    holder_.reset();
    output_.back() = {};
    output_.publish();
}

void ControlLease::check_silence(Time now) {
    if (holder_ && now - last_heard_ > duration) end();
}

ToolDriver ControlLease::driver_for(ClientId client) const {
    if (!holder_) return ToolDriver::nobody;
    return *holder_ == client ? ToolDriver::you : ToolDriver::another;
}

}  // namespace osteomill
