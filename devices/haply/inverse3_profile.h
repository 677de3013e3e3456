// Figures of Haply's Inverse3 that coupling and mapping need.
//
// Axes, as the service has them by default: right-handed, x to the right, y away from the user, z up, the
// origin at the base (docs.haply.co, Inverse SDK 3.5, "Basis Permutation"). Device space is the same in mm.
// Positions and forces are those of the cursor, about which the grip turns: the burr's centre is there, so
// turning the grip does not move the burr.
//
// No document of the maker's was found that has all of this; if a number is our own, it is on the safe side.
#pragma once

#include <glm/vec3.hpp>

namespace osteomill {

struct Inverse3Profile {
    /// Half of its stated peak, 10 N. A hand that mills feels 1 to 3 N; and a spring of the stiffness below
    /// that is drawn to 10 N holds 50 mJ, which the watchdog sees as a fault when it lets go (15 mJ,
    /// safety/watchdog.h).
    double max_force_n = 5.0;
    /// Our own: the force also passes the service, USB and the service's filters ("Filters", same place).
    double max_stiffness_n_per_mm = 1.0;
    /// Our own, an order of magnitude: the moving links and the grip.
    double apparent_mass_kg = 0.15;
    /// Our own, on the coarse side.
    double position_step_mm = 0.02;
    /// Device space. The maker's example sends the cursor there ("Control Commands").
    glm::dvec3 workspace_middle_mm{0.0, -120.0, 150.0};
    /// From the burr's tip to the shank in the grip's frame: a grip points along its +y ("06. Combined").
    glm::dvec3 spindle_axis_in_grip{0.0, -1.0, 0.0};
};

inline constexpr Inverse3Profile inverse3_profile{};

}  // namespace osteomill
