#include "simulation/cutting_force/binned_force.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <stdexcept>

namespace osteomill {

BinnedForce::BinnedForce(const ChipBins& bins)
    : bins_(bins), step_(Burr{}, {0.0, 0.0, 1.0}, glm::dvec3(0.0), 0.1, 1.0) {
    if (bins.psi < 1 || bins.z < 1)
        throw std::invalid_argument("a chip map needs at least one bin in psi and in z");
    weighted_volume_mm3_.resize(static_cast<std::size_t>(bins.psi) * static_cast<std::size_t>(bins.z));
}

void BinnedForce::begin_step(const Burr& burr, const CuttingStep& step) noexcept {
    step_ = step;
    radius_mm_ = burr.radius_mm();
    edges_ = burr.edges;
    teeth_ = burr.edges * burr.spindle_rev_per_s * step.elapsed_s;
    if (holds_any_) std::fill(weighted_volume_mm3_.begin(), weighted_volume_mm3_.end(), 0.0);
    holds_any_ = false;
    edges_n_ = glm::dvec3(0.0);
}

void BinnedForce::add(const RemovedVoxels& removed, std::span<const float> weights) noexcept {
    holds_any_ |= removed.count > 0;
    const double h = step_.spacing_mm;
    const glm::dvec3 middle = step_.middle_voxels - glm::dvec3(removed.base);
    for (std::size_t i = 0; i < removed.count; ++i) {
        if (weights[i] == 0.0f) continue;
        const glm::dvec3 from_middle_mm = (glm::dvec3(removed.x[i], removed.y[i], removed.z[i]) - middle) * h;
        const glm::dvec3 w(glm::dot(from_middle_mm, step_.frame[0]), glm::dot(from_middle_mm, step_.frame[1]),
                           glm::dot(from_middle_mm, step_.frame[2]));
        const double psi = std::atan2(w.y, w.x);
        const double turn = psi / (2.0 * std::numbers::pi) + (psi < 0.0 ? 1.0 : 0.0);
        const int bin_psi = std::clamp(static_cast<int>(turn * bins_.psi), 0, bins_.psi - 1);
        const int bin_z =
            std::clamp(static_cast<int>((w.z + radius_mm_) / slice_height_mm()), 0, bins_.z - 1);
        const auto bin = static_cast<std::size_t>(bin_z * bins_.psi + bin_psi);
        weighted_volume_mm3_[bin] += static_cast<double>(weights[i]) * h * h * h;
    }
}

void BinnedForce::add_edges(const CuttingStep& edges, const RemovedVoxels& rubbed,
                            std::span<const float> weights) noexcept {
    edges_n_ += edges.newton_per_unit * sum_of_chip_forces(edges, rubbed, weights, InstructionSet::plain);
}

double BinnedForce::slice_radius_mm(int z) const {
    const double height = -radius_mm_ + (z + 0.5) * slice_height_mm();
    return std::sqrt(radius_mm_ * radius_mm_ - height * height);
}

double BinnedForce::chip_thickness_mm(int psi, int z) const noexcept {
    const double psi_width_rad = 2.0 * std::numbers::pi / bins_.psi;
    return weighted_volume_mm3_[static_cast<std::size_t>(z * bins_.psi + psi)] /
           (teeth_ * slice_radius_mm(z) * psi_width_rad * slice_height_mm());
}

glm::dvec3 BinnedForce::force_n() const noexcept {
    const glm::dvec3 k(step_.coefficients);
    glm::dvec3 force{0.0};
    if (!holds_any_) return step_.frame * edges_n_;
    for (int z = 0; z < bins_.z; ++z) {
        const double cos_kappa = -(-radius_mm_ + (z + 0.5) * slice_height_mm()) / radius_mm_;
        const double sin_kappa = std::sqrt(1.0 - cos_kappa * cos_kappa);
        for (int bin = 0; bin < bins_.psi; ++bin) {
            const double chip_mm = chip_thickness_mm(bin, z);
            if (chip_mm <= 0.0) continue;
            const double psi = 2.0 * std::numbers::pi * (bin + 0.5) / bins_.psi;
            const glm::dvec3 normal(std::cos(psi) * sin_kappa, std::sin(psi) * sin_kappa, -cos_kappa);
            const glm::dvec3 e_psi(-std::sin(psi), std::cos(psi), 0.0);
            const glm::dvec3 e_kappa(std::cos(psi) * cos_kappa, std::sin(psi) * cos_kappa, sin_kappa);
            const glm::dvec3 per_mm = chip_mm * k;
            force -= per_mm.x * e_psi + per_mm.y * normal + per_mm.z * e_kappa;
        }
    }
    return step_.frame * (force * slice_height_mm() * edges_ / static_cast<double>(bins_.psi) + edges_n_);
}

}  // namespace osteomill
