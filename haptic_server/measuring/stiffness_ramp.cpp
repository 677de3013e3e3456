#include "haptic_server/measuring/stiffness_ramp.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "simulation/device/arm_spring.h"

namespace osteomill {

namespace {

// Ticks after a tap, between which two swings are compared.
constexpr std::size_t first_swing = 50;
constexpr std::size_t second_swing = 170;
constexpr std::size_t swing_end = 290;
constexpr double not_dying = 0.75;
constexpr double not_taken = 0.25;
constexpr double steps_felt = 1.0;
constexpr double noises_felt = 4.0;
constexpr double least_felt_mm = 0.02;
constexpr double sways_felt = 1.5;
/// For the speed: further apart, the steps of the encoder count less.
constexpr std::size_t speed_ticks = 3;
/// A tap's force, and in how many ticks it is given at most.
constexpr double tap_force_n = 1.0;
constexpr std::size_t longest_tap_ticks = 25;
/// Within which a swing crosses its middle twice, beyond this distance on both sides.
constexpr std::size_t swing_ticks = 150;
constexpr double crossing_mm = 0.2;

double mean(std::span<const MeasuredTick> ticks, glm::length_t k) {
    double sum = 0.0;
    for (const MeasuredTick& tick : ticks) sum += tick.position_mm[k];
    return sum / static_cast<double>(ticks.size());
}

double rms_mm(std::span<const MeasuredTick> ticks, glm::length_t k) {
    const double middle = mean(ticks, k);
    double sum = 0.0;
    for (const MeasuredTick& tick : ticks)
        sum += (tick.position_mm[k] - middle) * (tick.position_mm[k] - middle);
    return std::sqrt(sum / static_cast<double>(ticks.size()));
}

}  // namespace

StiffnessRamp::StiffnessRamp(const RampedArm& arm, const MeasuringGuard& guard)
    : arm_(arm), guard_(guard), observer_(arm.resolution_mm), record_(most_taps * listen_ticks) {
    // Each axis gets 30 mm/s: sqrt(3) as much along the diagonal.
    const double momentum_n_s = std::sqrt(3.0) * arm.moving_mass_kg * 0.001 * tap_mm_per_s;
    tap_ticks_ =
        std::clamp(static_cast<std::size_t>(std::ceil(momentum_n_s / tap_force_n / measuring_tick_s)),
                   std::size_t{3}, longest_tap_ticks);
    tap_n_ = std::min(momentum_n_s / (static_cast<double>(tap_ticks_) * measuring_tick_s) + arm.friction_n,
                      guard_.force_bound_n());
}

glm::dvec3 StiffnessRamp::tick(const DeviceState& arm, double now_s) noexcept {
    const bool was_open = guard_.is_open();
    guard_.look(arm, now_s);
    if (guard_.end() == MeasuringEnd::energy && is_swinging()) swinging_n_per_mm_ = stiffness_n_per_mm_;
    if (!guard_.is_open()) return guard_.pass(glm::dvec3(0.0));
    if (!was_open) place_mm_ = estimate_mm_ = arm.position_mm;
    const std::size_t missed = was_open ? guard_.missed() : 0;
    const glm::dvec3 pull_n = spring_n(arm.position_mm, measuring_tick_s * static_cast<double>(missed + 1));
    const glm::dvec3 off_mm = glm::abs(arm.position_mm - place_mm_);
    if (std::max({off_mm.x, off_mm.y, off_mm.z}) > farthest_swing_mm) {
        if (is_swinging()) swinging_n_per_mm_ = stiffness_n_per_mm_;
        guard_.shut(is_swinging() ? MeasuringEnd::done : MeasuringEnd::moved_away);
    }
    const glm::dvec3 force_n = guard_.pass(pull_n + tap_n());
    record_.add(arm.position_mm, force_n, missed);
    if (guard_.is_open() && since_tap().size() >= listen_ticks)
        judge(swings_on(0) || swings_on(1) || swings_on(2));
    return guard_.is_open() ? force_n : guard_.pass(glm::dvec3(0.0));
}

glm::dvec3 StiffnessRamp::spring_n(const glm::dvec3& position_mm, double elapsed_s) noexcept {
    const glm::dvec3 before_mm = estimate_mm_;
    estimate_mm_ = observer_.update(position_mm, elapsed_s);
    velocity_mm_per_s_ += elapsed_s / (ArmSpring::hand_filter_s + elapsed_s) *
                          ((estimate_mm_ - before_mm) / elapsed_s - velocity_mm_per_s_);
    place_mm_ += elapsed_s / (place_filter_s + elapsed_s) * (estimate_mm_ - place_mm_);
    guard_.stay_near(place_mm_);
    return -stiffness_n_per_mm_ * (estimate_mm_ - place_mm_) - arm_.damping_n_s_per_mm * velocity_mm_per_s_;
}

glm::dvec3 StiffnessRamp::tap_n() const noexcept {
    if (since_tap().size() >= tap_ticks_) return glm::dvec3(0.0);
    // To the four diagonals in turn.
    const double sign_y = taps_ % 2 == 0 ? 1.0 : -1.0;
    const double sign_z = taps_ / 2 % 2 == 0 ? 1.0 : -1.0;
    return tap_n_ / std::sqrt(3.0) * glm::dvec3(1.0, sign_y, sign_z);
}

bool StiffnessRamp::swings_on(std::size_t axis) const noexcept {
    const auto k = static_cast<glm::length_t>(axis);
    const std::span<const MeasuredTick> ticks = since_tap();
    const double before_mm = rms_mm(ticks.subspan(first_swing, second_swing - first_swing), k);
    const double after_mm = rms_mm(ticks.subspan(second_swing, swing_end - second_swing), k);
    const double felt_mm = std::max({steps_felt * arm_.resolution_mm, noises_felt * arm_.noise_mm,
                                     least_felt_mm, sways_felt * arm_.sway_mm});
    if (after_mm < felt_mm || after_mm < not_dying * before_mm) return false;

    // Work of the force on the arm, less that of the mean force over the mean motion.
    const auto whole = static_cast<std::size_t>(arm_.delay_ticks);
    const double part = arm_.delay_ticks - static_cast<double>(whole);
    const auto force_n = [&](std::size_t i) {
        return (1.0 - part) * ticks[i - whole].force_n[k] + part * ticks[i - whole - 1].force_n[k];
    };
    double work = 0.0;
    double all_n = 0.0;
    double squares_mm2_per_s = 0.0;
    for (std::size_t i = first_swing; i < swing_end; ++i) {
        const double step_mm = ticks[i + 1].position_mm[k] - ticks[i].position_mm[k];
        const double speed_mm_per_s =
            (ticks[i + speed_ticks].position_mm[k] - ticks[i - speed_ticks].position_mm[k]) /
            (2.0 * speed_ticks * measuring_tick_s);
        work += force_n(i) * step_mm;
        all_n += force_n(i);
        squares_mm2_per_s += speed_mm_per_s * speed_mm_per_s * measuring_tick_s;
    }
    const double moved_mm = ticks[swing_end].position_mm[k] - ticks[first_swing].position_mm[k];
    const double given_mj = work - all_n * moved_mm / static_cast<double>(swing_end - first_swing);
    return given_mj > -not_taken * arm_.damping_n_s_per_mm * squares_mm2_per_s;
}

bool StiffnessRamp::is_swinging() const noexcept {
    const std::span<const MeasuredTick> all = record_.from(0);
    const std::span<const MeasuredTick> ticks = all.last(std::min(all.size(), swing_ticks));
    if (ticks.empty()) return false;
    for (glm::length_t k = 0; k < 3; ++k) {
        const double middle = mean(ticks, k);
        int crossings = 0;
        double side = 0.0;
        for (const MeasuredTick& tick : ticks) {
            const double off_mm = tick.position_mm[k] - middle;
            if (std::abs(off_mm) < crossing_mm || off_mm * side > 0.0) continue;
            crossings += side != 0.0 ? 1 : 0;
            side = off_mm;
        }
        if (crossings >= 2) return true;
    }
    return false;
}

void StiffnessRamp::judge(bool swings) noexcept {
    tap_begins_ = record_.size();
    ++taps_;
    if (swings && swung_before_) {
        swinging_n_per_mm_ = stiffness_n_per_mm_;
        guard_.shut(MeasuringEnd::done);
    }
    swung_before_ = swings;
    if (swings) return;
    calm_n_per_mm_ = stiffness_n_per_mm_;
    if (stiffness_n_per_mm_ >= stiffest_n_per_mm || taps_ >= most_taps) guard_.shut(MeasuringEnd::done);
    stiffness_n_per_mm_ = std::min(growth * stiffness_n_per_mm_, stiffest_n_per_mm);
}

double sway_mm(std::span<const MeasuredTick> at_rest) {
    constexpr std::size_t window = swing_end - second_swing;
    double most_mm = 0.0;
    for (std::size_t begin = 0; begin + window <= at_rest.size(); begin += window)
        for (glm::length_t k = 0; k < 3; ++k)
            most_mm = std::max(most_mm, rms_mm(at_rest.subspan(begin, window), k));
    return most_mm;
}

}  // namespace osteomill
