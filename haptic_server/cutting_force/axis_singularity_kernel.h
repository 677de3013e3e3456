// Averaging kernel for voxels near the spindle's axis, where the law is singular. The force of a chip grows
// toward the axis as 1/r: taken at the voxel's middle it would be far too much or too little, and its mean
// over the voxel's cube is wrong wherever the chip's thickness slopes at the axis, as it does under a tilted
// burr (by 2 to 4 % of the force of a burr ten voxels thick). So its mean is taken over a disc about the
// voxel with weights that all but leave slopes and curvatures of what the voxels hold as they are. With t =
// (r / a)^2:
//
//     w(t) = 0.6 (13 - 32 t) (1 - t)^2 / (pi a^2),   t < 1.
//
// The second moment of w is a fifth of a cube's: none would be right where edges are soft, a cube's where the
// bone has a face along the lattice. a is such that the Fourier transform of w is zero at one wave a voxel,
// and at one in a diagonal of a voxel's face: the sum over voxels then does not tell where the lattice lies,
// nor does it under a burr that leans by 45 degrees. The weight within r is M(t) = 1 - (1 - t)^3 (1 - 4.8 t).
// The components of e / r, e the unit vector away from the axis, are harmonic, so their mean is M(t) e / r.
// The means over circles of e and of 1/r are complete elliptic integrals; of their means over w these are
// least-squares fits, within 0.3 % of e and, but for 1 % at t = 1, within 0.1 % of 1/r.
#pragma once

namespace osteomill {

/// Radius a of the disc, voxels.
inline constexpr float axis_disc_voxels = 1.93f;

/// Means over the disc about a point at a distance r from the axis, voxels. `Real` is a number or the lanes
/// of a vector.
template <typename Real>
struct AxisKernel {
    Real swirl;    ///< mean of e / r = this * (x, y)
    Real outward;  ///< mean of e = this * (x, y)
    Real inverse;  ///< mean of 1 / r
};

/// Where the disc does not reach the axis: r at least axis_disc_voxels. `per_r` is 1 / r.
template <typename Real>
[[gnu::always_inline]] inline AxisKernel<Real> far_axis_kernel(Real per_r) {
    const Real per_t = per_r * per_r * (axis_disc_voxels * axis_disc_voxels);
    return {per_r * per_r, per_r * (1.0f - 0.00125f * per_t),
            per_r * (1.0f + per_t * (0.0025f - per_t * (0.00893f + per_t * per_t * 0.01229f)))};
}

/// Anywhere. `per_r`: 1 / r, which may be anything finite where r is below 0.1.
template <typename Real>
[[gnu::always_inline]] inline AxisKernel<Real> axis_kernel(Real r_squared, Real per_r) {
    constexpr float per_a = 1.0f / axis_disc_voxels;
    const Real t = r_squared * (per_a * per_a);
    const Real swirl = (7.8f - t * (17.4f - t * (15.4f - t * 4.8f))) * (per_a * per_a);
    const Real outward = (2.69564f - t * (3.83297f - t * (3.14777f - t * 1.00984f))) * per_a;
    const Real inverse =
        (5.39530f - t * (15.56784f - t * (20.60255f - t * (11.68240f - t * 2.23097f)))) * per_a;
    const AxisKernel<Real> far = far_axis_kernel(per_r);
    return {t < 1.0f ? swirl : far.swirl, t < 1.0f ? outward : far.outward, t < 1.0f ? inverse : far.inverse};
}

}  // namespace osteomill
