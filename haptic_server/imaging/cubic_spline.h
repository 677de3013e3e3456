// Cubic B-spline interpolation on a lattice: passes through every voxel, with continuous curvature, so that a
// refined bone shows no steps of the scan's voxels. M. Unser, "Splines: a perfect fit for signal and image
// processing", IEEE Signal Processing Magazine 16(6), 1999. ITK computes the coefficients; the lattice
// continues beyond its ends as in a mirror.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "haptic_server/imaging/source_image.h"

namespace osteomill {

/// Coefficients and weights of one coordinate: value = sum of weight[i] * coefficient[index[i]].
struct SplineTaps {
    std::array<int, 4> index{};
    std::array<float, 4> weight{};
};

/// Taps at continuous coordinate `at` on an axis of `size` voxels; at lies within [-1, size].
SplineTaps spline_taps(double at, int size);

/// The spline's coefficients, in place of the image's values.
void values_to_coefficients(SourceImage& image);

/// Smooths each axis that is sampled finer than `spacing_mm` by the Gaussian that widens a voxel to it (full
/// widths at half maximum add in squares), so that a coarser lattice does not alias. Others stay as they are.
void smooth_for_spacing(SourceImage& image, double spacing_mm);

}  // namespace osteomill
