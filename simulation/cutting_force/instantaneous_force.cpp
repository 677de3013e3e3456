#include "simulation/cutting_force/instantaneous_force.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <stdexcept>

namespace osteomill {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
/// Radius of a disc as large as a voxel's cross-section, 1/sqrt(pi): how near to the spindle's axis a voxel
/// is taken to be at least.
constexpr double disc_radius_voxels = 0.56418958354775628695;

}  // namespace

InstantaneousForce::InstantaneousForce(int instants, InstructionSet instructions)
    : instants_(instants),
      instructions_(instructions),
      step_(Burr{}, {0.0, 0.0, 1.0}, glm::dvec3(0.0), 0.1, 1.0) {
    if (instants < 1 || instants > most_instants)
        throw std::invalid_argument("a tooth period has 1 to 64 instants, not " + std::to_string(instants));
}

void InstantaneousForce::turn(const Burr& burr, double elapsed_s) noexcept {
    if (burr.edges != edges_ || burr.sigma() != sigma_) {
        forget();
        turned_rad_ = 0.0;
    }
    edges_ = burr.edges;
    sigma_ = burr.sigma();
    pitch_rad_ = two_pi / burr.edges;
    turn_rad_ = two_pi * burr.spindle_rev_per_s * elapsed_s;
    turned_rad_ = std::fmod(turned_rad_ + turn_rad_, pitch_rad_);

    const double tooth_period_s = 1.0 / (burr.edges * burr.spindle_rev_per_s);
    const double kept = std::exp(-elapsed_s / tooth_period_s);
    window_s_ = kept * window_s_ + elapsed_s;
    for (int i = 0; i < instants_; ++i) impulse_[static_cast<std::size_t>(i)] *= kept;
}

void InstantaneousForce::begin_step(const CuttingStep& step) noexcept {
    step_ = step;
    step_sum_ = edges_n_ = glm::dvec3(0.0);
}

void InstantaneousForce::forget() noexcept {
    impulse_.fill(glm::dvec3(0.0));
    step_sum_ = edges_n_ = glm::dvec3(0.0);
    window_s_ = 0.0;
}

void InstantaneousForce::add(const RemovedVoxels& removed, std::span<const float> weights) noexcept {
    step_sum_ += sum_of_chip_forces(step_, removed, weights, instructions_);
    sort(step_, removed, weights);
}

void InstantaneousForce::add_edges(const CuttingStep& edges, const RemovedVoxels& rubbed,
                                   std::span<const float> weights) noexcept {
    edges_n_ += edges.newton_per_unit * sum_of_chip_forces(edges, rubbed, weights, instructions_);
    sort(edges, rubbed, weights);
}

void InstantaneousForce::correct(const glm::dvec3& by_n) noexcept {
    edges_n_ += by_n;
    for (int i = 0; i < instants_; ++i)
        impulse_[static_cast<std::size_t>(i)] += by_n * (step_.elapsed_s / instants_);
}

void InstantaneousForce::sort(const CuttingStep& step, const RemovedVoxels& voxels,
                              std::span<const float> weights) noexcept {
    chip_forces(step, voxels, weights, instructions_, forces_);
    const double to_impulse = step.newton_per_unit * step.elapsed_s;
    const double bins_per_rad = instants_ / pitch_rad_;
    for (std::size_t i = 0; i < voxels.count; ++i) {
        const glm::dvec3 force(forces_.force_x[i], forces_.force_y[i], forces_.force_z[i]);
        const double x = static_cast<double>(forces_.x[i]);
        const double y = static_cast<double>(forces_.y[i]);
        const double psi = sigma_ * std::atan2(y, x);
        const double bin_of_centre = (psi - pitch_rad_ * std::floor(psi / pitch_rad_)) * bins_per_rad;
        // A voxel is as wide as it is, seen from the spindle: it cuts in each bin that it reaches into.
        const double width = bins_per_rad / std::max(std::hypot(x, y), disc_radius_voxels);
        spread(to_impulse * force, bin_of_centre - 0.5 * width,
               std::min(width, static_cast<double>(instants_)));
    }
}

void InstantaneousForce::spread(const glm::dvec3& impulse, double first, double width) noexcept {
    const double last = first + width;
    for (double bin = std::floor(first); bin < last; bin += 1.0) {
        const double share = (std::min(last, bin + 1.0) - std::max(first, bin)) / width;
        const auto wrapped = static_cast<int>(bin) % instants_;
        impulse_[static_cast<std::size_t>(wrapped < 0 ? wrapped + instants_ : wrapped)] += share * impulse;
    }
}

glm::dvec3 InstantaneousForce::force_at_instant_n(int instant) const noexcept {
    if (window_s_ <= 0.0) return glm::dvec3(0.0);
    return step_.frame * (impulse_[static_cast<std::size_t>(instant)] * (instants_ / window_s_));
}

glm::dvec3 InstantaneousForce::force_n() const noexcept {
    if (turn_rad_ >= pitch_rad_ * (1.0 - 1e-9))
        return step_.frame * (step_.newton_per_unit * step_sum_ + edges_n_);
    if (window_s_ <= 0.0) return glm::dvec3(0.0);
    // Between the middles of the bins the force is taken to vary linearly, which leaves its mean as it is.
    const double bins_passed = turn_rad_ / pitch_rad_ * instants_;
    const int samples = static_cast<int>(std::ceil(4.0 * bins_passed));
    const double last = turned_rad_ / pitch_rad_ * instants_;
    glm::dvec3 impulse(0.0);
    for (int i = 0; i < samples; ++i) {
        const double at_bin = last - bins_passed * (i + 0.5) / samples - 0.5 + 2 * instants_;
        const auto bin = static_cast<std::size_t>(at_bin);
        const double share = at_bin - static_cast<double>(bin);
        const auto count = static_cast<std::size_t>(instants_);
        impulse += glm::mix(impulse_[bin % count], impulse_[(bin + 1) % count], share);
    }
    return step_.frame * (impulse * (instants_ / (window_s_ * samples)));
}

}  // namespace osteomill
