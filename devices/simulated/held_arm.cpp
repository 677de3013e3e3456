#include "devices/simulated/held_arm.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

namespace {

constexpr double two_pi = 6.28318530717958647692;
constexpr double mm_per_m = 1000.0;  // N / kg = m / s^2

/// Unit vector along a velocity, fading to zero well below 1 mm/s, at which a hand has no direction.
glm::dvec3 direction_of(const glm::dvec3& velocity_mm_per_s) noexcept {
    constexpr double hardly_moving_mm_per_s = 0.3;
    return velocity_mm_per_s / (glm::length(velocity_mm_per_s) + hardly_moving_mm_per_s);
}

}  // namespace

ArmAndHand::ArmAndHand(const ArmModel& arm, const HandModel& hand, const glm::dvec3& start_mm)
    : arm_(arm), hand_(hand), position_mm_(start_mm) {}

glm::dvec3 ArmAndHand::spring_force_n(const HandTarget& target) noexcept {
    const glm::dvec3 error_mm = target.position_mm - position_mm_;
    const double pull_n = hand_.stiffness_n_per_mm * glm::length(error_mm + correction_mm_);

    const glm::dvec3 corrected_mm = correction_mm_ + two_pi * hand_.correction_hz * substep_s *
                                                         glm::dot(error_mm, target.spindle_axis) *
                                                         target.spindle_axis;
    const double corrected_pull_n = hand_.stiffness_n_per_mm * glm::length(error_mm + corrected_mm);
    // A hand that already pushes as hard as it will does not store up more.
    if (corrected_pull_n <= hand_.max_push_n || corrected_pull_n <= pull_n) correction_mm_ = corrected_mm;

    const glm::dvec3 force_n = hand_.stiffness_n_per_mm * (error_mm + correction_mm_);
    const double size_n = glm::length(force_n);
    return size_n > hand_.max_push_n ? force_n * (hand_.max_push_n / size_n) : force_n;
}

void ArmAndHand::step(const HandTarget& target, const glm::dvec3& motor_force_n) noexcept {
    const double mm_per_s_per_n = substep_s * mm_per_m / (arm_.mass_kg + hand_.mass_kg);
    const glm::dvec3 force_n =
        motor_force_n + spring_force_n(target) + hand_.damping_n_s_per_mm * target.velocity_mm_per_s +
        hand_.friction_compensation * arm_.coulomb_friction_n * direction_of(target.velocity_mm_per_s);
    const double damping_n_s_per_mm = arm_.damping_n_s_per_mm + hand_.damping_n_s_per_mm;
    glm::dvec3 velocity =
        (velocity_mm_per_s_ + mm_per_s_per_n * force_n) / (1.0 + mm_per_s_per_n * damping_n_s_per_mm);

    const double friction_mm_per_s = mm_per_s_per_n * arm_.coulomb_friction_n;
    const double speed = glm::length(velocity);
    velocity = speed <= friction_mm_per_s ? glm::dvec3(0.0) : velocity * (1.0 - friction_mm_per_s / speed);

    velocity_mm_per_s_ = velocity;
    position_mm_ += substep_s * velocity;
}

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
