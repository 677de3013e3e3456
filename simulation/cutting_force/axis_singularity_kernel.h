// Averaging kernel for voxels near the spindle's axis, where the law is singular. The force of a chip grows
// toward the axis as 1/r, so near it the means over a disc of radius a about the voxel are taken instead of
// the values at its middle, with the weight
//
//     w(t) = 0.6 (13 - 32 t) (1 - t)^2 / (pi a^2),   t = (r / a)^2 < 1.
//
// The means are least-squares fits, within 0.3 % of e and, but for 1 % at t = 1, within 0.1 % of 1/r.
// docs/milling-model.md derives the weight.
#pragma once

#include <algorithm>

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

/// Means if the disc does not reach the axis: r at least axis_disc_voxels. `per_r` is 1 / r.
template <typename Real>
[[gnu::always_inline]] inline AxisKernel<Real> far_axis_kernel(Real per_r) {
    const Real per_t = per_r * per_r * (axis_disc_voxels * axis_disc_voxels);
    return {per_r * per_r, per_r * (1.0f - 0.00125f * per_t),
            per_r * (1.0f + per_t * (0.0025f - per_t * (0.00893f + per_t * per_t * 0.01229f)))};
}

/// Means at any r. `per_r`: 1 / r, which may be anything finite if r is below 0.1.
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

/// Part of the swirl that is missing on a face that ends in a straight line at the axis, such as the face on
/// which the edges of an upright burr rub. There the disc reaches over the line, and so do voxels, of which
/// only the part on the face counts. So 0.52 voxels of each edge are lost: pi / 2 times the mean distance,
/// from the line, of the disc's weight spread over a voxel. Times (x, y), the correction is zero at the axis,
/// and adds up to the lost part.
template <typename Real>
[[gnu::always_inline]] inline Real swirl_lost_at_line(Real r_squared) {
    constexpr float per_a_squared = 1.0f / (axis_disc_voxels * axis_disc_voxels);
    const Real rest = 1.0f - r_squared * per_a_squared;
    return rest > 0.0f ? 3.85f * per_a_squared * rest * rest : rest * 0.0f;
}

/// Share of that loss at a line that passes the axis at a distance, voxels.
inline float share_lost_at_line(float distance_voxels) {
    return std::max(0.0f, 1.0f - 2.0f * distance_voxels);
}

}  // namespace osteomill
