// Cubic B-spline interpolation on a lattice: passes through every voxel, with continuous curvature, so that a
// refined bone shows no steps of the scan's voxels. M. Unser, "Splines: a perfect fit for signal and image
// processing", IEEE Signal Processing Magazine 16(6), 1999. The lattice continues beyond its ends as in a
// mirror. Everything works in place, where ITK's filters (whose arithmetic this is) would need the image
// three times over.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <span>

namespace osteomill {

/// Coefficients and weights of one coordinate: value = sum of weight[i] * coefficient[index[i]].
struct SplineTaps {
    std::array<int, 4> index{};
    std::array<float, 4> weight{};
};

/// Taps at continuous coordinate `at` on an axis of `size` voxels; at lies within [-1, size].
SplineTaps spline_taps(double at, int size);

/// An image's lattice of values that is worked on in place.
struct Lattice {
    glm::ivec3 size_voxels{0};
    glm::dvec3 spacing_mm{1.0};
    std::span<float> values{};            ///< x fastest, then y, then z
    std::function<void()> pause = [] {};  ///< see filter_lines
};

/// The spline's coefficients, in place of the image's values.
void values_to_coefficients(const Lattice& lattice);

/// Smooths each axis that is sampled finer than `spacing_mm` by the Gaussian that widens a voxel to it (full
/// widths at half maximum add in squares), so that a coarser lattice does not alias. Others stay as they are.
void smooth_for_spacing(const Lattice& lattice, double spacing_mm);

}  // namespace osteomill
