// The step of an arm's encoders, and the noise of its readings, from readings alone.
//
// Step. An encoder that moves slowly changes now and then by one count, and between such changes the reading
// stays to the bit. So a change with none in the two ticks before and after it is one count of one encoder,
// and its length one step at the tip. The step is the length below which 40 % of these lie: now and then two
// encoders count in the same tick. If noise is larger than a step, no change stands alone; then the readings
// of an axis still lie on a lattice, and the step is the length below which a tenth of the changes lie. If
// readings hardly ever repeat, no step is seen.
//
// Noise, rms of an axis. The second difference of white noise of deviation s has the variance 6 s^2, while a
// hand at 10 Hz and 0.1 mm leaves 0.0004 mm in it (Allan's way of telling noise from drift, Proc. IEEE
// 54:221, 1966). Taken in windows of 50 ms, of which the quietest quarter counts: there the hand crosses the
// fewest steps.
#pragma once

#include <span>

#include "haptic_server/measuring/measured_tick.h"

namespace osteomill {

/// Over ticks in which the arm moves, or is moved; mm. 0: no step was seen. Not real-time safe.
double encoder_step_mm(std::span<const MeasuredTick> ticks);

/// Over ticks of a hand that rests, at least 50; mm, the noisiest axis. Not real-time safe.
double reading_noise_mm(std::span<const MeasuredTick> at_rest);

}  // namespace osteomill
