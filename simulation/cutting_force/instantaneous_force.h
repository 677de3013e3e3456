// Milling force at an instant within the tooth period: equation (1), F(j) = sum_i sum_k T(i,j,k) [K_t K_r
// K_a]^T t(i,j,k) dz, on voxels. At the instant when the edges have turned by phi, edge i stands at psi =
// sigma (phi + 2 pi i / N_phi); the bone at the same phase of its tooth pitch is what the edges cut then. So
// the chip forces of the removed voxels, sorted by phase into N_theta bins, are the forces of N_theta
// instants:
//
//     F(j) = N_theta * sum of the chip forces with phase in bin j,      their mean is equation (2)
//
// A step shorter than a tooth period removes too little to show a whole revolution; the bins remember the
// last tooth period or so, as the bone remembers the cut of the tooth before.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "simulation/cutting_force/chip_force.h"

namespace osteomill {

class InstantaneousForce {
  public:
    static constexpr int most_instants = 64;

    /// Throws std::invalid_argument unless 1 <= instants <= most_instants.
    InstantaneousForce(int instants, InstructionSet instructions);

    /// The edges turn on for `elapsed_s`, and the bins forget with time. Another burr starts with empty bins.
    /// Everything from here on is real-time safe.
    void turn(const Burr& burr, double elapsed_s) noexcept;

    /// Voxels that add() takes from now on were cut in `step`, which may have lasted for several turns.
    void begin_step(const CuttingStep& step) noexcept;

    /// As MeanForce::add and add_edges.
    void add(const RemovedVoxels& removed, std::span<const float> weights) noexcept;
    void add_edges(const CuttingStep& edges, const RemovedVoxels& rubbed,
                   std::span<const float> weights) noexcept;

    /// As MeanForce::edges_n; a correction goes evenly to all phases.
    const glm::dvec3& edges_n() const noexcept { return edges_n_; }
    void correct(const glm::dvec3& by_n) noexcept;

    /// Empties the bins: the cut so far does not tell how the coming teeth cut.
    void forget() noexcept;

    /// Mean of F(j) over the angles that the edges passed in the last turn, N, patient axes. A turn of a
    /// tooth period or longer gives the mean force of the last step.
    glm::dvec3 force_n() const noexcept;

    /// F(j) for the middle of phase bin `instant`, N, patient axes.
    glm::dvec3 force_at_instant_n(int instant) const noexcept;

    int instants() const { return instants_; }
    /// Angle by which the edges have turned at the end of the step, within a tooth pitch.
    double turned_rad() const { return turned_rad_; }

  private:
    /// The chips' or edges' forces into the bins.
    void sort(const CuttingStep& step, const RemovedVoxels& voxels, std::span<const float> weights) noexcept;
    /// Over the bins from `first` on, `width` of them; both in bins, wrapped around the pitch.
    void spread(const glm::dvec3& impulse, double first, double width) noexcept;

    int instants_;
    InstructionSet instructions_;
    CuttingStep step_;
    int edges_ = 0;
    double sigma_ = 1.0;
    double pitch_rad_ = 1.0;
    double turn_rad_ = 0.0;  // the last
    double turned_rad_ = 0.0;
    double window_s_ = 0.0;
    glm::dvec3 step_sum_{0.0};                         // of the last step's chips alone, its units
    glm::dvec3 edges_n_{0.0};                          // of its edges alone, burr axes
    std::array<glm::dvec3, most_instants> impulse_{};  // N s, burr axes, over the window
    ChipForces forces_;
};

}  // namespace osteomill
