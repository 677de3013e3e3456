// The milling force from the bone that a step removed, without bins:
//
//     F = sum over removed voxels of s V (-sigma K_t e_psi - K_r n - K_a e_kappa) / (2 pi r n_rev dt)
//
// which is equation (2) of the published method, F = (1/N_theta) sum_j sum_i sum_k T(i,j,k) [K_t K_r K_a]^T
// t(i,j,k) dz, in the limit of fine bins: the bone removed at (psi, z) is the chip t that the M = N_phi n_rev
// dt teeth passing that angle cut, t = s V / (M r dpsi dz). So the mean does not depend on the number of
// edges at a given feed and spindle speed. Geometry as in Lee and Altintas 1996: burr frame, kappa = 0 at the
// tip,
//     n = (cos psi sin kappa, sin psi sin kappa, -cos kappa)
//     e_psi = (-sin psi, cos psi, 0)
//     e_kappa = (cos psi cos kappa, sin psi cos kappa, sin kappa).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/scene/burr.h"
#include "haptic_server/milling/burr_frame.h"

namespace osteomill {

/// Floor of r in 1/r, in voxels: the mean of 1/r over a voxel that sits on the spindle's axis.
inline constexpr double smallest_radius_voxels = 0.284;

/// Floor of r in the vectors e_psi / r and e_r / r, in voxels: the radius of a disc of a voxel's
/// cross-section, 1/sqrt(pi). Their components are harmonic, so their mean over a disc is the value at its
/// centre while the axis lies outside it, and (x, y) / radius^2 once it lies within. So a burr that plunges
/// off the lattice feels no sideways force.
inline constexpr double smallest_vector_radius_voxels = 0.5642;

/// Sums the force of one step, voxel by voxel. Real-time safe.
class CuttingForce {
  public:
    /// `centre` is the burr's centre half-way through the step, in voxel coordinates: directions taken from
    /// the step's end would leave a bias that no refinement removes. `elapsed_s` > 0.
    CuttingForce(const Burr& burr, const glm::dvec3& spindle_axis, const glm::dvec3& centre_voxels,
                 double spacing_mm, double elapsed_s)
        : frame_(burr_frame(spindle_axis)),
          centre_(centre_voxels),
          radius_voxels_(burr.radius_mm() / spacing_mm),
          tangential_(burr.sigma() * burr.cutting_coefficients_n_per_mm2.x),
          radial_(burr.cutting_coefficients_n_per_mm2.y),
          axial_(burr.cutting_coefficients_n_per_mm2.z),
          per_voxel_(spacing_mm * spacing_mm / (two_pi * burr.spindle_rev_per_s * elapsed_s)) {}

    /// A voxel that lost `weighted_fraction` (relative stiffness times the fraction removed, 0 to 1 and
    /// beyond).
    void add(const glm::dvec3& voxel, double weighted_fraction) {
        const glm::dvec3 w = voxel - centre_;
        const double z = glm::dot(w, frame_[2]);
        const double x = glm::dot(w, frame_[0]);
        const double y = glm::dot(w, frame_[1]);
        const double r_squared = x * x + y * y;
        const double cos_kappa = std::clamp(-z / radius_voxels_, -1.0, 1.0);
        const double sin_kappa = std::sqrt(1.0 - cos_kappa * cos_kappa);
        // V / r in units of the spacing: h^3 / (r h) = h^2 / r.
        const double per_r_squared =
            weighted_fraction /
            std::max(r_squared, smallest_vector_radius_voxels * smallest_vector_radius_voxels);
        const double per_r = weighted_fraction / std::max(std::sqrt(r_squared), smallest_radius_voxels);

        const double outward = radial_ * sin_kappa + axial_ * cos_kappa;
        burr_axes_force_.x -= per_r_squared * (outward * x - tangential_ * y);
        burr_axes_force_.y -= per_r_squared * (outward * y + tangential_ * x);
        burr_axes_force_.z -= per_r * (axial_ * sin_kappa - radial_ * cos_kappa);
    }

    /// Mean force of the bone on the burr during the step, N, patient axes.
    glm::dvec3 force_n() const { return frame_ * (per_voxel_ * burr_axes_force_); }

  private:
    static constexpr double two_pi = 6.28318530717958647692;

    glm::dmat3 frame_;
    glm::dvec3 centre_;
    double radius_voxels_;
    double tangential_;
    double radial_;
    double axial_;
    double per_voxel_;
    glm::dvec3 burr_axes_force_{0.0};
};

}  // namespace osteomill
