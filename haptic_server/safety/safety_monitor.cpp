#include "haptic_server/safety/safety_monitor.h"

namespace osteomill {

void SafetyMonitor::begin(Fault found, bool pedal, Clearance clearance) noexcept {
    found_ = found;
    keeps_off_ = found;
    if (found == Fault::none && guard_.state() == ForceGuard::State::off && clearance != Clearance::clear)
        keeps_off_ = clearance == Clearance::in_bone ? Fault::in_bone : guard_.fault();
    pedal_ = pedal && has_hand();
    if (found == Fault::device_lost || found == Fault::device_jumped) is_spindle_locked_ = true;
    if (has_hand() && !pedal) is_spindle_locked_ = false;
}

glm::dvec3 SafetyMonitor::pass(const glm::dvec3& wanted_n, bool is_sound, double elapsed_s) noexcept {
    if (keeps_off_ == Fault::none && !is_sound) keeps_off_ = found_ = Fault::not_a_number;
    was_engaged_ = guard_.is_engaged();
    const glm::dvec3 force_n = guard_.tick(wanted_n, keeps_off_, elapsed_s);
    if (has_just_let_go()) ++fault_counts_[static_cast<std::size_t>(guard_.fault())];
    return force_n;
}

}  // namespace osteomill
