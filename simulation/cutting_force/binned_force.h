// Milling force by bins, as published: the bone that a step removed is sorted into bins [psi, z] of the
// burr, which gives each bin's chip thickness; equation (2) sums over bins. Slower and coarser than
// chip_force.h, whose sum is the limit of fine bins; kept because it is the published method and because
// it shows the chip.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "simulation/cutting_force/chip_force.h"

namespace osteomill {

/// How the burr's surface is divided: bins in psi around the spindle, slices in z along it.
struct ChipBins {
    int psi = 72;
    int z = 50;
};

/// Chip thickness of one step, bin by bin. Allocates when constructed; begin_step, add and force_n are
/// real-time safe.
class BinnedForce {
  public:
    explicit BinnedForce(const ChipBins& bins);

    /// Empties the bins.
    void begin_step(const Burr& burr, const CuttingStep& step) noexcept;

    /// As MeanForce::add and add_edges.
    void add(const RemovedVoxels& removed, std::span<const float> weights) noexcept;
    void add_edges(const CuttingStep& edges, const RemovedVoxels& rubbed,
                   std::span<const float> weights) noexcept;

    /// As MeanForce::edges_n.
    const glm::dvec3& edges_n() const noexcept { return edges_n_; }
    void correct(const glm::dvec3& by_n) noexcept { edges_n_ += by_n; }

    /// Stiffness-weighted chip thickness of one tooth in a bin, mm: t = sum(s V) / (M r_z dpsi dz), M = N_phi
    /// n_rev dt.
    double chip_thickness_mm(int psi, int z) const noexcept;

    /// Equation (2): mean over a tooth period of sum T(i,j,k) [K_t K_r K_a]^T t(i,j,k) dz over edges and
    /// slices; N, patient axes. Each edge passes each bin once a revolution, so the mean over instants is a
    /// sum over bins times N_phi dpsi / 2 pi. The published method has no edge forces; they are those of
    /// chip_force.h.
    glm::dvec3 force_n() const noexcept;

  private:
    double slice_height_mm() const { return 2.0 * radius_mm_ / bins_.z; }
    double slice_radius_mm(int z) const;

    ChipBins bins_;
    CuttingStep step_;
    double radius_mm_ = 1.0;
    double edges_ = 1.0;
    double teeth_ = 1.0;                       // that passed each angle during the step
    bool holds_any_ = false;                   // or all bins are empty
    std::vector<double> weighted_volume_mm3_;  // [z][psi]
    glm::dvec3 edges_n_{0.0};                  // burr axes
};

}  // namespace osteomill
