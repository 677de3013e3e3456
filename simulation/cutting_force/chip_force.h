// Force of each voxel that a step removed, without bins:
//
//     f = s V (-sigma K_t e_psi - K_r n - K_a e_kappa) / (2 pi r n_rev dt)
//
// Summed over the removed voxels this is equation (2) of the published method, F = (1/N_theta) sum_j sum_i
// sum_k T(i,j,k) [K_t K_r K_a]^T t(i,j,k) dz, in the limit of fine bins: the bone removed at (psi, z) is the
// chip t that the M = N_phi n_rev dt teeth passing that angle cut, t = s V / (M r dpsi dz). So the mean does
// not depend on the number of edges at a given feed and spindle speed. Geometry as in Lee and Altintas 1996:
// burr frame, kappa = 0 at the tip,
//     n = (cos psi sin kappa, sin psi sin kappa, -cos kappa)
//     e_psi = (-sin psi, cos psi, 0)
//     e_kappa = (cos psi cos kappa, sin psi cos kappa, sin kappa).
//
// A voxel of the crescent is up to a voxel off the burr's surface. Its force is computed at its own position,
// at a distance d from the burr's centre: r = d sin kappa. The loss of a shell grows with d^2 and the force
// with 1 / d. In the ramp of voxel_coverage.h d is R on average, so the mean over it equals that of the
// surface. If voxels were first moved to r = R sin kappa, the sum would be too large by the ramp's variance
// over R^2, 0.5 % for a burr of ten voxels. With K_r n + K_a e_kappa written out, sin kappa / r = 1 / d
// leaves only e_psi / r, e_r / r, e_r and 1 / r that vary quickly near the spindle's axis: these are replaced
// by the means of axis_singularity_kernel.h.
//
// A cutting edge also rubs (Altintas's linear edge model; Lee and Altintas 1996): dF = (K_te, K_re, K_ae) ds
// for each mm of it, however thin the chip. So this force belongs to the face that is cut, not to the bone
// that a step removes: at a slow feed, a step takes only single levels of a voxel's 255. It is summed over
// the voxels that the burr would cut if it advanced by d, a voxel or more; each has V / (n . d) of the face
// (edge_advance):
//
//     f = s V / (n . d) N_phi (-sigma K_te e_psi - K_re n - K_ae e_kappa) / (2 pi r)
//
// the law of chips with other coefficients and weights. edge_look.h leads from there back to the burr.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "common/scene/burr.h"
#include "common/scene/burr_profile.h"
#include "simulation/carving/instruction_set.h"
#include "simulation/carving/removed_voxels.h"

namespace osteomill {

/// A milling step for the force sum: of its chips, or of its edges.
struct CuttingStep {
    /// A step of chips. `middle_voxels` is the burr's centre half-way through the step, in voxel coordinates:
    /// directions taken from the step's end would leave a bias that no refinement removes. `elapsed_s` > 0;
    /// `spindle_axis` is a unit vector. `head_profile`: in voxels, null for a ball; outlives the step.
    CuttingStep(const Burr& burr, const glm::dvec3& spindle_axis, const glm::dvec3& middle_voxels,
                double spacing_mm, double elapsed_s, const BurrProfile* head_profile = nullptr);

    /// A step of the edges meanwhile: its bone is the bone that the burr would cut on `path_voxels` (not
    /// zero) from `from_voxels`.
    CuttingStep of_edges(const Burr& burr, const glm::dvec3& from_voxels,
                         const glm::dvec3& path_voxels) const;

    glm::dmat3 frame;  ///< burr axes in patient axes
    glm::dvec3 middle_voxels;
    double spacing_mm;
    glm::vec3 coefficients;  ///< sigma K_t, K_r, K_a; of edges sigma K_te, K_re, K_ae
    double elapsed_s;
    /// Force in N = this * the sums over `ChipForces`.
    double newton_per_unit;
    bool is_of_edges = false;
    glm::vec3 path_direction{0.0f};  ///< of edges: unit, burr axes
    float half_path_voxels = 0.0f;   ///< likewise
    float line_lost = 0.0f;          ///< likewise: share_lost_at_line() of axis_singularity_kernel.h
    const BurrProfile* head;         ///< null: a ball
};

/// Force of each voxel of a batch, and where the voxel lies; burr axes, voxels. Scratch: set by chip_forces
/// up to the batch's padded count.
struct ChipForces {
    alignas(64) std::array<float, RemovedVoxels::capacity> force_x;
    alignas(64) std::array<float, RemovedVoxels::capacity> force_y;
    alignas(64) std::array<float, RemovedVoxels::capacity> force_z;
    alignas(64) std::array<float, RemovedVoxels::capacity> x;
    alignas(64) std::array<float, RemovedVoxels::capacity> y;
    alignas(64) std::array<float, RemovedVoxels::capacity> z;
};

/// `weights`: of each voxel, relative stiffness times the fraction removed; zero for padding. Real-time safe.
void chip_forces(const CuttingStep& step, const RemovedVoxels& removed, std::span<const float> weights,
                 InstructionSet instructions, ChipForces& out) noexcept;

/// Sum of the same forces; burr axes, in units of CuttingStep::newton_per_unit. Real-time safe.
glm::dvec3 sum_of_chip_forces(const CuttingStep& step, const RemovedVoxels& removed,
                              std::span<const float> weights, InstructionSet instructions) noexcept;

// Advance of the burr into the face of a removed voxel, as a share of the burr's path in the step: the
// voxel's volume divided by it is the area on which edges rub.
//
// The share is n . d / |d|, with the voxel's normal n from the burr's centre half-way. But the normal turns
// by 2 w while the burr passes, w = |d| / 2 over the distance, and on a face nearly along the path, bone is
// cut during only a part of the step. With x = n . d / |d| at half-way, n . d / |d| runs from x - w to x + w;
// where both signs occur, bone is cut during (x + w) / 2 w of the step with a mean advance of (x + w)^2 / 4
// w, and their ratio is the area that rubs:
//
//     volume / |d| = area x,                    x > w
//     volume / |d| = area (x + w) / 2,         |x| < w

/// Least w: fractions of 255 levels resolve no smaller one. It leaves out a strip of a third of a degree.
inline constexpr float least_turn = 0.006f;

/// The larger of x and (x + w) / 2, and never below w / 4. `Real` is a number or the lanes of a vector.
template <typename Real>
[[gnu::always_inline]] inline Real edge_advance(Real x, Real w) {
    const Real partly = (x + w) * 0.5f;
    const Real advance = x > partly ? x : partly;
    const Real least = w * 0.25f;
    return advance > least ? advance : least;
}

}  // namespace osteomill
