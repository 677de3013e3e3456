// Advance of the burr into the face of a removed voxel, as a share of the burr's path in the step: the
// voxel's volume divided by it is the area on which edges rub (chip_force.h).
//
// The share is n . d / |d|, with the voxel's normal n from the burr's centre half-way. But the normal turns
// by 2 w while the burr passes, w = |d| / 2 over the distance, and on a face nearly along the path, bone is
// cut during only a part of the step. With x = n . d / |d| at half-way, n . d / |d| runs from x - w to x + w;
// where both signs occur, bone is cut during (x + w) / 2 w of the step with a mean advance of (x + w)^2 / 4
// w, and their ratio is the area that rubs:
//
//     volume / |d| = area x,                    x > w
//     volume / |d| = area (x + w) / 2,         |x| < w
#pragma once

namespace osteomill {

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
