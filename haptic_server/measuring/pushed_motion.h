// Mass, damping, stiffness and friction of arm and hand when the arm pushes along one axis, and the delay of
// the force.
//
//     m x'' + b x' + k x + c + F_c sgn(x') = u(t - d)     u the written force, held from tick to tick
//
// Multiplied by a smooth bump that is zero with three derivatives at the ends of a window of 60 ms, and
// integrated by parts, the derivatives fall on the bump, and no reading is ever differentiated (Shinbrot,
// Trans. ASME 79:547, 1957; Preisig and Rippin, Computers chem. Engng 17:1, 1993):
//
//     m int x w'' - b int x w' + k int x w + c int w + F_c int sgn(x') w = int u(t - d) w
//
// A window every 5 ms gives a line each; m, b, k, c, F_c are the least squares' solution. The delay d is the
// one at which what is left over is least, of 0 to 12 ms by 0.1. The sign of x' is a smooth one, of the
// motion over 8 ms.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "haptic_server/measuring/measured_tick.h"

namespace osteomill {

struct PushedMotion {
    double mass_kg = 0.0;      ///< of the arm and the part of the hand that moves with it
    double friction_n = 0.0;   ///< Coulomb's
    double delay_ticks = 0.0;  ///< beyond the tick in which a written force begins to act
    double explained = 0.0;    ///< share of the force's variance, 0 to 1
};

/// The motion in ticks in which the arm pushed along `axis`, 0 to 2, with readings in steps of `step_mm` (0:
/// none to speak of). Nothing if the arm hardly moved, or moved in another way than it was pushed. Not
/// real-time safe.
std::optional<PushedMotion> pushed_motion(std::span<const MeasuredTick> ticks, std::size_t axis,
                                          double step_mm);

}  // namespace osteomill
