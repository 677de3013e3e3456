// Analytical reference force, the published model without voxels: a burr in steady motion against bone that a
// function describes. The yardstick for the voxel model, never a part of it.
//
//     F(j) = sum_i sum_k T(i,j,k) [K_t K_r K_a]^T t(i,j,k) dz      (1) force at instant j
//     F    = (1/N_theta) sum_j F(j)                                (2) mean over a tooth period
//
// with the geometry of chip_force.h and t = f_t max(0, n . v/|v|) / sin kappa, f_t = |v| / (N_phi n_rev):
// the chip's thickness in the burr's cylindrical coordinates, so that t dz = (normal thickness) x (arc R
// dkappa), as in Lee and Altintas 1996. Edges that rub add (K_te, K_re, K_ae) for each mm where t > 0. T is 1
// where the bone function says bone, else 0. Sums over k and over instants are midpoint quadratures over
// kappa and psi. For a head that is no ball, kappa is the angle of its outline's normal and R dkappa the
// outline's ds.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "common/scene/burr.h"

namespace osteomill::study {

/// A burr moving steadily; patient axes.
struct SteadyMotion {
    Burr burr;
    glm::dvec3 position_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit, tip to shank
    glm::dvec3 velocity_mm_per_s{0.0};
};

/// Relative stiffness of the bone at a point, 0 where there is none. Called for points of the burr's surface
/// only. Bone that the burr has cut in an earlier pass (a groove) must be missing. Bone behind the burr need
/// not be, since only the half of the burr that faces the motion cuts.
using BoneFunction = std::function<double(const glm::dvec3& position_mm)>;

/// Points of the quadrature along the outline (of a ball: along kappa) and along psi.
struct Quadrature {
    int kappa = 180;
    int psi = 720;
};

/// Equation (2): mean force of the bone on the burr over a tooth period, N.
glm::dvec3 mean_reference_force_n(const SteadyMotion& motion, const BoneFunction& bone,
                                  const Quadrature& quadrature = {});

/// Sum of the magnitudes of that force's parts, N: errors are of the parts, also where these nearly cancel.
double mean_reference_parts_n(const SteadyMotion& motion, const BoneFunction& bone,
                              const Quadrature& quadrature = {});

/// Equation (1): force at the instant when edge 0 has turned by `turned_rad` from the burr's x axis in the
/// sense of rotation, N. An edge trails by `helix_lag_rad_per_mm` for each mm above the tip.
glm::dvec3 instantaneous_reference_force_n(const SteadyMotion& motion, const BoneFunction& bone,
                                           double turned_rad, double helix_lag_rad_per_mm = 0.0,
                                           const Quadrature& quadrature = {});

/// Removal rate, mm^3/s: integral of max(0, n . v) over the part of the burr's surface in bone.
double reference_removal_mm3_per_s(const SteadyMotion& motion, const BoneFunction& bone,
                                   const Quadrature& quadrature = {});

/// Bone of relative stiffness 1 below the plane z = 0.
BoneFunction flat_bone();

/// That bone after a burr of `radius_mm` has passed along the line through `position_mm` in direction
/// `direction` (unit).
BoneFunction flat_bone_with_groove(const glm::dvec3& position_mm, const glm::dvec3& direction,
                                   double radius_mm);

}  // namespace osteomill::study
