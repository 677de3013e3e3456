// The spring of an arm that was measured (haptic_server/measuring/arm_measurement.h), by the rule of
// arm_spring.h. A measurement takes the place of the claim, and may go beyond it:
//
//     K is at most 2/3 of the stiffest spring on which the arm came to rest, beside the same damper
//
// instead of what the arm claims, and instead of what its friction stills: both were there when it came to
// rest. The other limits stay, with what was measured in them where that is worse than what the arm states:
// the lesser of the masses (a hand that let go leaves the arm alone), the longer delay, the coarser step. So
// an arm that swings in no hand does not swing without one.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulation/device/arm_spring.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

/// Figures of an arm as they were measured on it, with a hand on it (haptic_server --measure-arm). Device
/// space.
struct MeasuredArm {
    double calm_n_per_mm = 0.0;       ///< stiffest spring on which the arm came to rest after a tap
    double damping_n_s_per_mm = 0.0;  ///< the damper beside it, through ArmSpring::hand_filter_s
    double step_mm = 0.0;             ///< of a reading; 0: none was seen
    double noise_mm = 0.0;            ///< rms of what a reading jitters, of the worst axis
    std::optional<double> delay_s{};  ///< from a written force to its motion, beyond the tick that it takes
    std::optional<double> moving_mass_kg{};  ///< the least of the axes; the hand moves with it
    std::optional<double> friction_n{};      ///< Coulomb's, the least of the axes

    /// Standard deviations of noise that count as a step: within +-2 nothing is proven
    /// (position_observer.h). Up to half a step, noise is a reading that goes to and fro between two steps.
    static constexpr double noises_in_step = 4.0;
    double resolution_mm() const {
        const double beyond_mm2 = noise_mm * noise_mm - 0.25 * step_mm * step_mm;
        return std::max(step_mm, noises_in_step * std::sqrt(std::max(0.0, beyond_mm2)));
    }
};

/// `arm`: its limits as it states them, or with the spring that they give; `delay_s`: from a reading to its
/// force, as far as the arm's driver knows. Not real-time safe, as all here.
DeviceLimits with_measured_spring(DeviceLimits arm, double delay_s, const MeasuredArm& measured);

/// Before the ramp, which needs a damper: the one that allows the stiffest spring if the ramp finds all calm,
/// of 1 to 12 N s/m by a half. `calm_n_per_mm` and the damper of `measured` are not read.
ArmSpring hoped_spring(const DeviceLimits& arm, double delay_s, const MeasuredArm& measured);

}  // namespace osteomill
