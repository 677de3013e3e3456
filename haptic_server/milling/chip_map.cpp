#include "haptic_server/milling/chip_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "haptic_server/milling/burr_frame.h"

namespace osteomill {

ChipMap::ChipMap(const ChipBins& bins) : bins_(bins) {
    if (bins.psi < 1 || bins.z < 1)
        throw std::invalid_argument("a chip map needs at least one bin in psi and in z");
    weighted_volume_mm3_.resize(static_cast<std::size_t>(bins.psi) * static_cast<std::size_t>(bins.z));
}

void ChipMap::begin_step(const Burr& burr, const glm::dvec3& spindle_axis, const glm::dvec3& centre_voxels,
                         double spacing_mm, double elapsed_s) {
    burr_.diameter_mm = burr.diameter_mm;
    burr_.edges = burr.edges;
    burr_.spindle_rev_per_s = burr.spindle_rev_per_s;
    burr_.cutting_coefficients_n_per_mm2 = burr.cutting_coefficients_n_per_mm2;
    burr_.sense = burr.sense;
    frame_ = burr_frame(spindle_axis);
    centre_ = centre_voxels;
    spacing_mm_ = spacing_mm;
    elapsed_s_ = elapsed_s;
    std::fill(weighted_volume_mm3_.begin(), weighted_volume_mm3_.end(), 0.0);
}

void ChipMap::add(const glm::dvec3& voxel, double weighted_fraction) {
    const glm::dvec3 w = (voxel - centre_) * spacing_mm_;
    const double psi = std::atan2(glm::dot(w, frame_[1]), glm::dot(w, frame_[0]));
    const double turn = psi / (2.0 * std::numbers::pi) + (psi < 0.0 ? 1.0 : 0.0);
    const int bin_psi = std::clamp(static_cast<int>(turn * bins_.psi), 0, bins_.psi - 1);
    const int bin_z = std::clamp(
        static_cast<int>((glm::dot(w, frame_[2]) + burr_.radius_mm()) / slice_height_mm()), 0, bins_.z - 1);
    weighted_volume_mm3_[static_cast<std::size_t>(bin_z * bins_.psi + bin_psi)] +=
        weighted_fraction * spacing_mm_ * spacing_mm_ * spacing_mm_;
}

double ChipMap::slice_radius_mm(int z) const {
    const double height = -burr_.radius_mm() + (z + 0.5) * slice_height_mm();
    return std::sqrt(burr_.radius_mm() * burr_.radius_mm() - height * height);
}

double ChipMap::chip_thickness_mm(int psi, int z) const {
    const double teeth = burr_.edges * burr_.spindle_rev_per_s * elapsed_s_;
    const double psi_width_rad = 2.0 * std::numbers::pi / bins_.psi;
    return weighted_volume_mm3_[static_cast<std::size_t>(z * bins_.psi + psi)] /
           (teeth * slice_radius_mm(z) * psi_width_rad * slice_height_mm());
}

glm::dvec3 ChipMap::force_n() const {
    const glm::dvec3& k = burr_.cutting_coefficients_n_per_mm2;
    const double tangential = burr_.sigma() * k.x;
    glm::dvec3 force{0.0};
    for (int z = 0; z < bins_.z; ++z) {
        const double cos_kappa = -(-burr_.radius_mm() + (z + 0.5) * slice_height_mm()) / burr_.radius_mm();
        const double sin_kappa = std::sqrt(1.0 - cos_kappa * cos_kappa);
        for (int bin = 0; bin < bins_.psi; ++bin) {
            const double chip_mm = chip_thickness_mm(bin, z);
            if (chip_mm <= 0.0) continue;
            const double psi = 2.0 * std::numbers::pi * (bin + 0.5) / bins_.psi;
            const glm::dvec3 normal(std::cos(psi) * sin_kappa, std::sin(psi) * sin_kappa, -cos_kappa);
            const glm::dvec3 e_psi(-std::sin(psi), std::cos(psi), 0.0);
            const glm::dvec3 e_kappa(std::cos(psi) * cos_kappa, std::sin(psi) * cos_kappa, sin_kappa);
            force -= chip_mm * (tangential * e_psi + k.y * normal + k.z * e_kappa);
        }
    }
    return frame_ *
           (force * slice_height_mm() * static_cast<double>(burr_.edges) / static_cast<double>(bins_.psi));
}

}  // namespace osteomill
