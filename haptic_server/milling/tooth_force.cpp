#include "haptic_server/milling/tooth_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace osteomill {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

}  // namespace

ToothForce::ToothForce(int instants, InstructionSet instructions)
    : instants_(instants),
      instructions_(instructions),
      step_(Burr{}, {0.0, 0.0, 1.0}, glm::dvec3(0.0), 0.1, 1.0) {
    if (instants < 1 || instants > most_instants)
        throw std::invalid_argument("a tooth period has 1 to 64 instants, not " + std::to_string(instants));
}

void ToothForce::begin_step(const Burr& burr, const CuttingStep& step) noexcept {
    const double pitch_rad = two_pi / burr.edges;
    const double tooth_period_s = 1.0 / (burr.edges * burr.spindle_rev_per_s);
    if (burr.edges != edges_ || burr.sigma() != sigma_) {
        impulse_.fill(glm::dvec3(0.0));
        window_s_ = 0.0;
        turned_rad_ = 0.0;
    }
    edges_ = burr.edges;
    sigma_ = burr.sigma();
    pitch_rad_ = pitch_rad;
    step_ = step;
    step_sum_ = glm::dvec3(0.0);
    step_angle_rad_ = two_pi * burr.spindle_rev_per_s * step.elapsed_s;
    turned_rad_ = std::fmod(turned_rad_ + step_angle_rad_, pitch_rad_);

    const double kept = std::exp(-step.elapsed_s / tooth_period_s);
    window_s_ = kept * window_s_ + step.elapsed_s;
    for (int i = 0; i < instants_; ++i) impulse_[static_cast<std::size_t>(i)] *= kept;
}

void ToothForce::add(const RemovedVoxels& removed, std::span<const float> weights) noexcept {
    chip_forces(step_, removed, weights, instructions_, forces_);
    step_sum_ += sum_of(forces_, removed.padded_count());
    const double to_impulse = step_.newton_per_unit * step_.elapsed_s;
    const double bins_per_rad = instants_ / pitch_rad_;
    for (std::size_t i = 0; i < removed.count; ++i) {
        const double psi =
            sigma_ * std::atan2(static_cast<double>(forces_.y[i]), static_cast<double>(forces_.x[i]));
        const double phase = psi - pitch_rad_ * std::floor(psi / pitch_rad_);
        const auto bin =
            static_cast<std::size_t>(std::min(static_cast<int>(phase * bins_per_rad), instants_ - 1));
        impulse_[bin] += to_impulse * glm::dvec3(forces_.force_x[i], forces_.force_y[i], forces_.force_z[i]);
    }
}

glm::dvec3 ToothForce::force_at_instant_n(int instant) const noexcept {
    if (window_s_ <= 0.0) return glm::dvec3(0.0);
    return step_.frame * (impulse_[static_cast<std::size_t>(instant)] * (instants_ / window_s_));
}

glm::dvec3 ToothForce::force_n() const noexcept {
    if (step_angle_rad_ >= pitch_rad_ * (1.0 - 1e-9))
        return step_.frame * (step_.newton_per_unit * step_sum_);
    // The step passed the phases from `first` to `turned_rad_`; where they wrap, in two parts.
    const double bin_rad = pitch_rad_ / instants_;
    const double first_rad = turned_rad_ - step_angle_rad_;
    glm::dvec3 impulse(0.0);
    for (int i = 0; i < instants_; ++i) {
        const auto overlap = [&](double shift_rad) {
            return std::max(0.0, std::min(turned_rad_ + shift_rad, (i + 1) * bin_rad) -
                                     std::max(first_rad + shift_rad, i * bin_rad));
        };
        impulse += (overlap(0.0) + overlap(pitch_rad_)) * impulse_[static_cast<std::size_t>(i)];
    }
    return step_.frame * (impulse * (instants_ / (window_s_ * step_angle_rad_)));
}

}  // namespace osteomill
