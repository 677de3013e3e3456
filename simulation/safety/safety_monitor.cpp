#include "simulation/safety/safety_monitor.h"

#include "common/bone/patient_space.h"

namespace osteomill {

void SafetyMonitor::begin(FaultSet found, PedalSeen pedal, Clearance clearance) noexcept {
    found_ = found;
    keeps_off_ = found.first();
    if (found.is_empty() && guard_.state() == ForceGuard::State::off && clearance != Clearance::clear)
        keeps_off_ = clearance == Clearance::in_bone ? Fault::in_bone : guard_.fault();
    if (is_untried_ && found.is_empty() && clearance == Clearance::in_bone) keeps_off_ = Fault::in_bone;
    if (!found.is_empty() || clearance != Clearance::unknown) is_untried_ = false;
    pedal_.tick(has_hand() ? pedal : PedalSeen::lapsed, found.withdraws_pedal());
    if (!pedal_.is_locked()) spindle_locked_by_ = Fault::none;
    if (found.withdraws_pedal()) spindle_locked_by_ = found.first();
}

glm::dvec3 SafetyMonitor::pass(const glm::dvec3& wanted_n, bool is_sound, double elapsed_s) noexcept {
    if (!is_sound) found_.add(Fault::not_a_number);
    if (keeps_off_ == Fault::none) keeps_off_ = found_.first();
    was_engaged_ = guard_.is_engaged();
    // A force that is no number is a fault, felt or not.
    const glm::dvec3 felt_n = is_untried_ && is_finite(wanted_n) ? glm::dvec3(0.0) : wanted_n;
    const glm::dvec3 force_n = guard_.tick(felt_n, keeps_off_, elapsed_s);
    if (!guard_.is_engaged()) is_untried_ = false;
    if (has_just_let_go()) {
        force_taken_by_ = guard_.fault();
        ++fault_counts_[static_cast<std::size_t>(force_taken_by_)];
        pedal_.withdraw();
        if (pedal_.is_locked()) spindle_locked_by_ = guard_.fault();
    }
    return force_n;
}

}  // namespace osteomill
