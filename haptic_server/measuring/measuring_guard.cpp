#include "haptic_server/measuring/measuring_guard.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "haptic_server/measuring/arm_estimates.h"

namespace osteomill {

const char* text_of(MeasuringEnd end) {
    switch (end) {
        case MeasuringEnd::none:
            return "it was stopped";
        case MeasuringEnd::done:
            return "it was done";
        case MeasuringEnd::pedal_up:
            return "the pedal was let go; hold it until the end";
        case MeasuringEnd::arm_lost:
            return "the arm was lost; look at its cable, its power and its calibration";
        case MeasuringEnd::not_finite:
            return "the arm read a position that is no number";
        case MeasuringEnd::late:
            return "the loop stood still for 20 ms or more; haptic_server --check says what makes it late";
        case MeasuringEnd::moved_away:
            return "the hand moved away; hold the arm at one place";
        case MeasuringEnd::energy:
            return "the hand got more than 15 mJ within 0.1 s; hold the arm a little firmer";
    }
    return "";
}

void MeasuringGuard::look(const DeviceState& arm, double now_s) noexcept {
    elapsed_s_ = has_looked_ ? now_s - looked_s_ : measuring_tick_s;
    has_looked_ = true;
    looked_s_ = now_s;
    missed_ = static_cast<std::size_t>(
        std::clamp(std::round(elapsed_s_ / measuring_tick_s) - 1.0, 0.0, longest_gap_s / measuring_tick_s));
    pedal_.tick(pedal_date_.look(arm.pedal, now_s), !arm.connected);
    energy_.add(arm.position_mm, force_n_, elapsed_s_, longest_step_mm);
    if (!is_open_) {
        if (!pedal_.is_pressed() || !std::isfinite(glm::length(arm.position_mm))) return;
        is_open_ = true;
        place_mm_ = arm.position_mm;
        return;
    }
    if (!arm.connected)
        shut(MeasuringEnd::arm_lost);
    else if (!pedal_.is_pressed())
        shut(MeasuringEnd::pedal_up);
    else if (!std::isfinite(glm::length(arm.position_mm)))
        shut(MeasuringEnd::not_finite);
    else if (elapsed_s_ >= longest_gap_s)
        shut(MeasuringEnd::late);
    else if (glm::distance(arm.position_mm, place_mm_) > farthest_mm)
        shut(MeasuringEnd::moved_away);
    else if (energy_.lately_mj() > most_energy_mj)
        shut(MeasuringEnd::energy);
}

glm::dvec3 MeasuringGuard::pass(const glm::dvec3& wanted_n) noexcept {
    const double size_n = glm::length(wanted_n);
    if (is_open() && !std::isfinite(size_n)) shut(MeasuringEnd::not_finite);
    if (!is_open()) return force_n_ = glm::dvec3(0.0);
    const glm::dvec3 bounded_n = size_n > force_bound_n_ ? wanted_n * (force_bound_n_ / size_n) : wanted_n;
    const glm::dvec3 change_n = bounded_n - force_n_;
    const double most_n = slew_n_per_s * measuring_tick_s;
    const double change = glm::length(change_n);
    return force_n_ = change > most_n ? force_n_ + change_n * (most_n / change) : bounded_n;
}

}  // namespace osteomill
