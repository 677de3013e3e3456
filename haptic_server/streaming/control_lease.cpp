#include "haptic_server/streaming/control_lease.h"

namespace osteomill {

bool ControlLease::take_input(ClientId client, const OperatorIntent& intent, Time now) {
    if (holder_ && *holder_ != client && is_kept(now)) return false;
    if (holder_ != client) activity_.begin();
    activity_.note(intent, now);
    holder_ = client;
    last_heard_ = now;
    input_ = {.hand_target = {.position_mm = intent.hand_target_mm, .spindle_axis = intent.spindle_axis},
              .pedal = intent.pedal,
              .burr = intent.burr};
    publish(true);
    return true;
}

void ControlLease::leave(ClientId client) {
    if (holder_ == client) end();
}

void ControlLease::end() {
    holder_.reset();
    publish(false);
}

void ControlLease::check_silence(Time now) {
    if (holder_ && now - last_heard_ > duration) end();
}

ToolDriver ControlLease::driver_for(ClientId client) const {
    if (!holder_) return ToolDriver::nobody;
    return *holder_ == client ? ToolDriver::you : ToolDriver::another;
}

void ControlLease::publish(bool present) {
    input_.present = present;
    if (!present) input_.pedal = false;
    output_.back() = input_;
    output_.publish();
}

}  // namespace osteomill
