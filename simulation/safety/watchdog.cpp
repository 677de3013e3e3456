#include "simulation/safety/watchdog.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "common/bone/patient_space.h"

namespace osteomill {

FaultSet Watchdog::check(const Observation& seen) noexcept {
    if (seen.model_step != model_step_) {
        model_step_ = seen.model_step;
        model_changed_s_ = seen.now_s;
    }
    overrun_periods_ = seen.missed_periods == 0 ? 0 : overrun_periods_ + seen.missed_periods;

    const bool is_lost =
        !seen.device.connected || !is_finite(seen.device.position_mm) || !is_finite(seen.device.spindle_axis);
    bool jumped = false;
    if (is_lost) {
        has_position_ = false;  // wherever it comes back, that is no jump
    } else {
        const double reach_mm = jump_allowance_mm + fastest_hand_mm_per_s * (seen.now_s - position_s_);
        jumped = has_position_ && glm::distance(seen.device.position_mm, position_mm_) > reach_mm;
        has_position_ = true;
        position_mm_ = seen.device.position_mm;
        position_s_ = seen.now_s;
    }

    FaultSet found;
    if (is_lost) found.add(Fault::device_lost);
    if (jumped) found.add(Fault::device_jumped);
    if (seen.now_s - model_changed_s_ > longest_model_age_s) found.add(Fault::model_stalled);
    if (!seen.model_valid) found.add(Fault::not_a_number);
    if (seen.energy_to_hand_mj > most_energy_to_hand_mj) found.add(Fault::energy_to_hand);
    if (seen.holds_still) found.add(Fault::paused);
    if (static_cast<double>(overrun_periods_) * tick_s_ >= longest_overrun_s) found.add(Fault::overrun);
    return found;
}

}  // namespace osteomill
