// What is particular to Haply's Inverse3, of what coupling and mapping want to know of an arm.
//
// Axes, as the service has them by default: right-handed, x to the right, y away from the user, z up, the
// origin at the base (docs.haply.co, Inverse SDK 3.5, "Basis Permutation"). Device space is the same in mm.
// The service puts all into newtons at the cursor, where the grip is held by a ball joint: that is where the
// burr's centre is, so turning the grip does not move the burr.
//
// The maker publishes no table that says all of this; where a number is our own, it is on the safe side.
#pragma once

#include <glm/vec3.hpp>

namespace osteomill {

struct Inverse3Profile {
    /// As advertised, for a peak; a hand that mills feels 1 to 3 N.
    double max_force_n = 10.0;
    /// Our own: the force also passes the service, USB and the service's filters ("Filters", same place).
    double max_stiffness_n_per_mm = 1.0;
    /// Our own, an order of magnitude: three links of carbon tube and the grip.
    double apparent_mass_kg = 0.15;
    /// Our own: the encoders are finer, the radio of the grip does not matter to it.
    double position_step_mm = 0.02;
    /// Where the service's own examples send the cursor to, and about the middle of its reach, device space.
    glm::dvec3 workspace_middle_mm{0.0, -120.0, 150.0};
    /// From the burr's tip to the shank in the grip's frame: a grip points along its +y ("06. Combined").
    glm::dvec3 spindle_axis_in_grip{0.0, -1.0, 0.0};
};

inline constexpr Inverse3Profile inverse3_profile{};

}  // namespace osteomill
