#include "devices/client/target_limit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {

glm::dvec3 TargetLimit::limited(const glm::dvec3& wanted_mm, const glm::dvec3& burr_mm,
                                double now_s) noexcept {
    glm::dvec3 target_mm = wanted_mm;
    const glm::dvec3 reach_mm = wanted_mm - burr_mm;
    if (const double length_mm = glm::length(reach_mm); !(length_mm <= longest_reach_mm)) {
        // The length of a finite vector may be none: it is then too far in any direction.
        target_mm = std::isfinite(length_mm) ? burr_mm + reach_mm * (longest_reach_mm / length_mm) : burr_mm;
        was_out_of_reach_.store(true, std::memory_order_relaxed);
    }

    room_left_mm_ = std::min(room_mm, room_left_mm_ + fastest_hand_mm_per_s * (now_s - limited_s_));
    limited_s_ = now_s;
    const glm::dvec3 step_mm = target_mm - target_mm_;
    const double step_length_mm = glm::length(step_mm);
    const double allowed_mm = std::min(step_length_mm, room_left_mm_);
    if (allowed_mm < step_length_mm) {
        target_mm = target_mm_ + step_mm * (allowed_mm / step_length_mm);
        was_too_fast_.store(true, std::memory_order_relaxed);
    }
    room_left_mm_ -= allowed_mm;
    return target_mm_ = target_mm;
}

const char* TargetLimit::notice() const noexcept {
    const bool reach = was_out_of_reach_.load(std::memory_order_relaxed);
    const bool speed = was_too_fast_.load(std::memory_order_relaxed);
    // The values of operator_command.h, which the messages below state.
    static_assert(longest_reach_mm == 6.0 && fastest_hand_mm_per_s == 500.0);
    if (reach && speed)
        return "the operator's target was more than 6 mm from the burr at the arm, and faster than a hand "
               "(500 mm/s): "
               "such targets are clamped";
    if (reach)
        return "the operator's target was more than 6 mm from the burr at the arm: such targets are clamped";
    if (speed) return "the operator's target was faster than a hand (500 mm/s): such targets are clamped";
    return "";
}

}  // namespace osteomill
