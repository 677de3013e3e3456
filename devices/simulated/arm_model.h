// A PHANTOM-Omni-like haptic arm as the hand feels it: an isotropic point mass with Coulomb and viscous
// friction, whose position is read in encoder steps.
//
// Figures of the PHANTOM Omni / Touch data sheet: apparent mass at the tip 45 g, backdrive friction 0.26 N,
// nominal position resolution 0.055 mm, peak force 3.3 N, stiffness about 1.3 to 2.3 N/mm by axis. Not in
// the data sheet: viscous friction, 0.1 N s/m, the least that such arms show.
#pragma once

#include "simulation/device/arm_spring.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

struct ArmModel {
    double mass_kg = 0.045;
    double coulomb_friction_n = 0.26;    ///< static and sliding alike
    double damping_n_s_per_mm = 0.0001;  ///< viscous
    double resolution_mm = 0.055;        ///< of the position read, each axis; 0 reads exactly
    double max_force_n = 3.3;            ///< the motors give no more
    /// Between the softest and the stiffest axis. Its mass and steps allow 1.99 beside 6.5 N s/m, as
    /// haptic_server --measure-arm finds, but beyond this its steps are felt (docs/results/stability.md).
    double max_stiffness_n_per_mm = 1.7;
    int delay_ms = 0;  ///< after which a written force acts, beside the tick that it takes
};

/// The arm at a hand whose poses are prescribed. It has no encoder steps, so it bears what its stiffest axis
/// does; with them, in a hand, it does not (arm_spring.h).
constexpr ArmModel ideal_arm() {
    return {.resolution_mm = 0.0, .max_stiffness_n_per_mm = 2.3};
}

inline DeviceLimits limits_of(const ArmModel& arm) {
    return with_stiffest_spring(
        {.max_force_n = arm.max_force_n,
         .max_stiffness_n_per_mm = arm.max_stiffness_n_per_mm,
         .apparent_mass_kg = arm.mass_kg,
         .position_resolution_mm = arm.resolution_mm},
        0.001 * arm.delay_ms,
        arm.coulomb_friction_n > 0.0 ? std::optional(arm.coulomb_friction_n) : std::nullopt);
}

}  // namespace osteomill
