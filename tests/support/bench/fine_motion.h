// The motion of a body, with Coulomb friction, in substeps of a few microseconds.
//
// Implicit midpoint: the spring and the damper act at the middle of the substep, where the velocity is the
// mean of its ends. The method is of second order, and neither gains nor loses a spring's energy, so that any
// energy a run gains comes from the sampled force. Semi-implicit Euler would shift the position by half a
// substep against the force: at 10 us, 1 % of the shift by a hold of 1 ms. A constant force alone is followed
// exactly.
//
// Coulomb friction is a force against the motion; if it would turn the motion round within the substep, the
// body stops at that time, and rests while the other forces are no larger than the friction.
#pragma once

#include "tests/support/bench/held_body.h"

namespace osteomill::testing {

/// One substep under a constant force on the body.
MotionState fine_step(const HeldBody& body, const MotionState& state, double force_n, double substep_s);

}  // namespace osteomill::testing
