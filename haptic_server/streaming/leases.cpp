#include "haptic_server/streaming/leases.h"

namespace osteomill {

bool ToolLease::take_input(ClientId client, const OperatorCommand& command, Time now) {
    if (holder_ && *holder_ != client && is_kept(now)) return false;
    if (holder_ != client || command.pedal || newest_ != command) acted_ = now;
    if (holder_ != client) releases_ = 0;
    if (!command.pedal) ++releases_;
    newest_ = command;
    holder_ = client;
    last_heard_ = now;
    output_.back() = {command, now, client, releases_};
    output_.publish();
    return true;
}

void ToolLease::leave(ClientId client) {
    if (holder_ == client) end();
}

void ToolLease::end() {
    holder_.reset();
    output_.back() = {};
    output_.publish();
}

void ToolLease::check_silence(Time now) {
    if (holder_ && now - last_heard_ > duration) end();
}

ToolDriver ToolLease::driver_for(ClientId client) const {
    if (!holder_) return ToolDriver::nobody;
    return *holder_ == client ? ToolDriver::you : ToolDriver::another;
}

}  // namespace osteomill
