#include "simulation/safety/force_guard.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/bone/patient_space.h"

namespace osteomill {

namespace {

glm::dvec3 limited(const glm::dvec3& v, double longest) noexcept {
    // Scaled by the largest component first: the square of a huge one would overflow.
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0.0) return v;
    const glm::dvec3 scaled = v / largest;
    const double length = glm::length(scaled);
    return largest * length > longest ? scaled * (longest / length) : v;
}

}  // namespace

glm::dvec3 ForceGuard::approach(const glm::dvec3& wanted_n, double tick_s) const noexcept {
    return force_n_ + limited(limited(wanted_n, max_force_n_) - force_n_, slew_n_per_s * tick_s);
}

glm::dvec3 ForceGuard::tick(const glm::dvec3& wanted_n, Fault fault, double tick_s) noexcept {
    if (fault == Fault::none && !is_finite(wanted_n)) fault = Fault::not_a_number;

    if (fault != Fault::none) {
        if (is_engaged()) {
            state_ = State::fading_out;
            in_state_s_ = 0.0;
            faded_n_ = force_n_;
        }
        fault_ = fault;
    }

    in_state_s_ += tick_s;  // `active`, which lasts, does not use it
    switch (state_) {
        case State::active:
            force_n_ = approach(wanted_n, tick_s);
            break;
        case State::fading_out:
            force_n_ = faded_n_ * std::max(0.0, 1.0 - in_state_s_ / fade_out_s);
            if (in_state_s_ >= fade_out_s) {
                state_ = State::off;
                in_state_s_ = 0.0;
            }
            break;
        case State::off:
            force_n_ = glm::dvec3(0.0);
            // A tick that comes late lasts longer than settle_s: however long, one with a fault starts anew.
            if (fault != Fault::none) in_state_s_ = 0.0;
            if (in_state_s_ > settle_s) {
                state_ = State::fading_in;
                in_state_s_ = 0.0;
            }
            break;
        case State::fading_in:
            force_n_ =
                approach(limited(wanted_n, max_force_n_) * std::min(1.0, in_state_s_ / fade_in_s), tick_s);
            if (in_state_s_ >= fade_in_s) state_ = State::active;
            break;
    }
    return force_n_;
}

}  // namespace osteomill
