#include "haptic_server/safety/safety_monitor.h"

namespace osteomill {

void SafetyMonitor::begin(Fault found, bool pedal) noexcept {
    found_ = found;
    pedal_ = pedal && has_hand();
    if (found == Fault::device_lost || found == Fault::device_jumped) is_spindle_locked_ = true;
    if (has_hand() && !pedal) is_spindle_locked_ = false;
}

glm::dvec3 SafetyMonitor::pass(const glm::dvec3& wanted_n, bool is_sound, double elapsed_s) noexcept {
    if (found_ == Fault::none && !is_sound) found_ = Fault::not_a_number;
    was_engaged_ = guard_.is_engaged();
    const glm::dvec3 force_n = guard_.tick(wanted_n, found_, elapsed_s);
    if (has_just_let_go()) ++fault_counts_[static_cast<std::size_t>(guard_.fault())];
    return force_n;
}

}  // namespace osteomill
