#include "devices/simulated/held_arm.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

HeldArm::HeldArm(const ArmModel& arm, const HandModel& hand, const glm::dvec3& start_mm)
    : arm_(arm),
      motion_(arm, hand, start_mm),
      sensor_(arm.resolution_mm),
      target_mm_(start_mm),
      late_n_(static_cast<std::size_t>(std::max(arm.delay_ms, 0)), glm::dvec3(0.0)) {
    sensor_.read(start_mm, 0.0);
}

void HeldArm::advance(double now_s, const glm::dvec3& target_mm, const glm::dvec3& spindle_axis) noexcept {
    const auto substeps_until_now = std::llround(now_s / ArmAndHand::substep_s);
    constexpr auto most = static_cast<long long>(longest_catch_up_s / ArmAndHand::substep_s);
    if (substeps_until_now - substeps_done_ > most) substeps_done_ = substeps_until_now - most;

    const long long count = substeps_until_now - substeps_done_;
    if (count > 0) {
        const double span_s = static_cast<double>(count) * ArmAndHand::substep_s;
        const glm::dvec3 velocity = (target_mm - target_mm_) / span_s;
        for (long long i = 1; i <= count; ++i) {
            const glm::dvec3 position =
                target_mm_ + (static_cast<double>(i) * ArmAndHand::substep_s) * velocity;
            motion_.step({position, velocity, spindle_axis}, motor_force_n_);
        }
        substeps_done_ = substeps_until_now;
        target_mm_ = target_mm;
    }
    sensor_.read(motion_.position_mm(), now_s - read_at_s_);
    read_at_s_ = now_s;
}

void HeldArm::set_motor_force(const glm::dvec3& force_n) noexcept {
    const double size_n = glm::length(force_n);
    glm::dvec3 said_n = size_n > arm_.max_force_n ? force_n * (arm_.max_force_n / size_n) : force_n;
    if (!std::isfinite(size_n)) said_n = glm::dvec3(0.0);
    if (!late_n_.empty()) {
        std::swap(said_n, late_n_[next_late_]);
        next_late_ = (next_late_ + 1) % late_n_.size();
    }
    motor_force_n_ = said_n;
}

}  // namespace osteomill
