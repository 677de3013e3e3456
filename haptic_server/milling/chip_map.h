// The milling force by bins, as published: the bone that a step removed is sorted into bins [psi, z] of the
// burr, which gives each bin's chip thickness; equation (2) sums over bins. Slower and coarser than
// cutting_force.h, whose sum is the limit of fine bins; kept because it is the published method and because
// it shows the chip.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/scene/burr.h"

namespace osteomill {

/// How the burr's surface is divided: bins in psi around the spindle, slices in z along it.
struct ChipBins {
    int psi = 72;
    int z = 50;
};

/// Chip thickness of one step, bin by bin. Allocates when constructed; begin_step, add and force_n are
/// real-time safe.
class ChipMap {
  public:
    explicit ChipMap(const ChipBins& bins);

    /// Empties the bins for a step of `elapsed_s` > 0 with the burr's centre (half-way through) at
    /// `centre_voxels`.
    void begin_step(const Burr& burr, const glm::dvec3& spindle_axis, const glm::dvec3& centre_voxels,
                    double spacing_mm, double elapsed_s);

    /// A voxel that lost `weighted_fraction` (relative stiffness times the fraction removed).
    void add(const glm::dvec3& voxel, double weighted_fraction);

    /// Stiffness-weighted chip thickness of one tooth in a bin, mm: t = sum(s V) / (M r_z dpsi dz), M = N_phi
    /// n_rev dt.
    double chip_thickness_mm(int psi, int z) const;

    /// Equation (2): mean over a tooth period of sum T(i,j,k) [K_t K_r K_a]^T t(i,j,k) dz over edges and
    /// slices; N, patient axes. Each edge passes each bin once a revolution, so the mean over instants is a
    /// sum over bins times N_phi dpsi / 2 pi.
    glm::dvec3 force_n() const;

  private:
    double slice_height_mm() const { return 2.0 * burr_.radius_mm() / bins_.z; }
    double slice_radius_mm(int z) const;

    ChipBins bins_;
    Burr burr_;
    glm::dmat3 frame_{1.0};
    glm::dvec3 centre_{0.0};
    double spacing_mm_ = 0.1;
    double elapsed_s_ = 1.0;
    std::vector<double> weighted_volume_mm3_;  // [z][psi]
};

}  // namespace osteomill
