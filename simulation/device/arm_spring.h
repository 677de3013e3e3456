// The stiffest spring that a coupling may put on an arm, with the damper beside it (coupling_spring.h).
//
//     F = -K (x - p) - B (v - w)      v, w of arm and burr through filters of tau_x and tau_p
//
// K is the least of
//
//     what the arm claims to render
//     2/3 of the stiffest wall that holds: arm, spring, damper and filter, sampled each T and late by the
//         delay, are stable. The arm is held by nobody and has 0.5 N s/m of its own
//     2 F_c / q                         Coulomb friction F_c takes what a step q of the encoder gives back
//         (Diolaiti et al., IEEE Trans. Robotics 22:256, 2006)
//     (30 mN - B c q a / T) / (c q)     a step of the encoder is not felt: c of it comes in one tick where
//         bone is cut (position_observer.h), with a = T / (tau_x + T)
//     (0.15 N - B v T / (tau_p + T)) / (v T)    a wall that is met at v = 40 mm/s is not felt as a jump
//
// B is 4 N s/m, or 5, 8 or 12 if that allows a stiffer spring; less if a light, late arm is unstable
// with 4.
#pragma once

#include <optional>

#include "simulation/device/haptic_device.h"

namespace osteomill {

/// With a longer delay between a reading and its force the coupling's own damper shakes the arm, and no
/// spring helps: osteomill_study bridge.
inline constexpr double longest_delay_s = 0.003;

/// An arm's figures, in device space.
struct ArmFigures {
    double claimed_n_per_mm = 1.5;
    const char* claimed_by = "all that the arm claims to render";
    double mass_kg = 0.045;
    double position_resolution_mm = 0.0;  ///< 0: none to speak of
    std::optional<double> friction_n{};   ///< Coulomb's; not given: not known
    double delay_s = 0.001;  ///< from a reading to its force; up to a tick, with which this reckons anyway
};

/// Device space.
struct ArmSpring {
    double stiffness_n_per_mm = 1.5;
    double damping_n_s_per_mm = 0.004;
    const char* limited_by = "";  ///< for people

    static constexpr double tick_s = 0.001;
    static constexpr double hand_filter_s = 0.001;  ///< tau_x
    static constexpr double burr_filter_s = 0.01;   ///< tau_p
    static constexpr double share_of_step = 0.1;    ///< c
    static constexpr double felt_step_n = 0.03;
    static constexpr double felt_jump_n = 0.15;
    static constexpr double touch_mm_per_s = 40.0;
    static constexpr double share_of_edge = 2.0 / 3.0;
    /// However coarse and late an arm, less is no spring.
    static constexpr double softest_n_per_mm = 0.05;
};

/// The stiffest stable wall on an arm of `mass_kg` > 0 with `damping_n_s_per_mm` beside it, N/mm, for a delay
/// of so many ms (0 or more; interpolated between whole ones); 0: none.
double stiffest_wall_n_per_mm(double mass_kg, double damping_n_s_per_mm, double delay_ms);

/// The least of the limits with that damper. Not real-time safe, as all below.
ArmSpring spring_beside(const ArmFigures& arm, double damping_n_s_per_mm);

ArmSpring stiffest_spring(const ArmFigures& arm);

/// The limits with that spring in place of the claimed one.
DeviceLimits with_stiffest_spring(DeviceLimits arm, double delay_s,
                                  std::optional<double> friction_n = std::nullopt);

}  // namespace osteomill
