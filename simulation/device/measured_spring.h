// The spring of an arm that was measured (measured_arm.h), by the rule of arm_spring.h. A measurement takes
// the place of the claim, and may go beyond it:
//
//     K is at most 2/3 of the stiffest spring on which the arm came to rest, beside the same damper
//
// instead of what the arm claims, and instead of what its friction stills: both were there when it came to
// rest. The other limits stay, with what was measured in them where that is worse than what the arm states:
// the lesser of the masses (a hand that let go leaves the arm alone), the longer delay, the coarser step. So
// an arm that swings in no hand does not swing without one.
#pragma once

#include "simulation/device/arm_spring.h"
#include "simulation/device/device_limits.h"
#include "simulation/device/measured_arm.h"

namespace osteomill {

/// `arm`: its limits as it states them, or with the spring that they give; `delay_s`: from a reading to its
/// force, as far as the arm's driver knows. Not real-time safe, as all here.
DeviceLimits with_measured_spring(DeviceLimits arm, double delay_s, const MeasuredArm& measured);

/// Before the ramp, which needs a damper: the one that allows the stiffest spring if the ramp finds all calm,
/// of 1 to 12 N s/m by a half. `calm_n_per_mm` and the damper of `measured` are not read.
ArmSpring hoped_spring(const DeviceLimits& arm, double delay_s, const MeasuredArm& measured);

}  // namespace osteomill
