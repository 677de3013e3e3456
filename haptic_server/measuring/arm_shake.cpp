#include "haptic_server/measuring/arm_shake.h"

#include <algorithm>
#include <cmath>

namespace osteomill {

glm::dvec3 ArmShake::tick(const DeviceState& arm, double now_s) noexcept {
    guard_.look(arm, now_s);
    if (!guard_.is_open()) return guard_.pass(glm::dvec3(0.0));
    if (record_.size() == 0) middle_mm_ = arm.position_mm;
    middle_mm_ += measuring_tick_s / (middle_filter_s + measuring_tick_s) * (arm.position_mm - middle_mm_);
    // A hand wanders while it rests; from then on it is held to its place.
    if (record_.size() < rest_ticks) guard_.stay_near(middle_mm_);
    const glm::dvec3 force_n = guard_.pass(wanted_n(arm.position_mm));
    record_.add(arm.position_mm, force_n, record_.size() == 0 ? 0 : guard_.missed());
    if (record_.size() == rest_ticks + 3 * push_ticks) {
        guard_.shut(MeasuringEnd::done);
        return guard_.pass(glm::dvec3(0.0));
    }
    return force_n;
}

glm::dvec3 ArmShake::wanted_n(const glm::dvec3& position_mm) noexcept {
    if (record_.size() < rest_ticks) return glm::dvec3(0.0);
    const std::size_t axis = std::min<std::size_t>((record_.size() - rest_ticks) / push_ticks, 2);
    const auto k = static_cast<glm::length_t>(axis);
    const double off_mm = position_mm[k] - middle_mm_[k];
    if (axis_ != axis || record_.size() == rest_ticks) {
        axis_ = axis;
        push_n_ = first_push_n;
        in_group_ = 0;
        speed_mm_per_s_ = 0.0;
        last_off_mm_ = off_mm;
    }
    speed_mm_per_s_ += measuring_tick_s / (speed_filter_s + measuring_tick_s) *
                       ((off_mm - last_off_mm_) / measuring_tick_s - speed_mm_per_s_);
    last_off_mm_ = off_mm;
    if (in_group_ == 4 * quarter_periods[group_]) begin_group();
    if (in_group_ == 0) lowest_mm_ = highest_mm_ = off_mm;
    lowest_mm_ = std::min(lowest_mm_, off_mm);
    highest_mm_ = std::max(highest_mm_, off_mm);
    const std::size_t quarter = in_group_++ / quarter_periods[group_];
    const double push_n = quarter == 1 || quarter == 2 ? -push_n_ : push_n_;
    glm::dvec3 wanted(0.0);
    wanted[k] = sense_ * push_n - middle_n_per_mm * off_mm - middle_n_s_per_mm * speed_mm_per_s_;
    return wanted;
}

void ArmShake::begin_group() noexcept {
    const double went_mm = highest_mm_ - lowest_mm_;
    if (went_mm < enough_mm) push_n_ = std::min(growth * push_n_, guard_.force_bound_n());
    if (went_mm > too_far_mm) push_n_ /= growth;
    group_ = (group_ + 1) % quarter_periods.size();
    sense_ = -sense_;
    in_group_ = 0;
}

}  // namespace osteomill
