// Models of an arm and of the hand that holds it.
#pragma once

#include <optional>
#include <string>

#include "simulation/device/arm_spring.h"
#include "simulation/device/haptic_device.h"

namespace osteomill {

/// A PHANTOM-Omni-like haptic arm as the hand feels it: an isotropic point mass with Coulomb and viscous
/// friction, whose position is read in encoder steps.
///
/// Figures of the PHANTOM Omni / Touch data sheet: apparent mass at the tip 45 g, backdrive friction 0.26 N,
/// nominal position resolution 0.055 mm, peak force 3.3 N, stiffness about 1.3 to 2.3 N/mm by axis. Not in
/// the data sheet: viscous friction, 0.1 N s/m, the least that such arms show.
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

/// The hand that holds the arm: a mass on a spring and a damper, pulled towards the intended position of the
/// tool, and a slow correction of that intent by eye.
///
///     F_hand = K (x_target + c - x) + B (v_target - v) + g F_f u    |K (...)| <= max_push
///     dc/dt  = 2 pi f a a^T (x_target - x)                     f = correction_hz, a = spindle axis
///
/// u points along v_target: a hand used to its arm adds the share g of the friction F_f to its push. Without
/// this the tool trails a light hand by a millimetre and cuts corners.
///
/// Sources. The form, a second-order lump, is that of Hajian and Howe (J. Biomech. Eng. 119:109, 1997: the
/// finger in extension, a few hundred N/m, 2 to 7 N s/m, a few grams), Kuchenbecker, Park and Niemeyer (ASME
/// IMECE 2003: the wrist around a stylus) and Israr, Choi and Tan (IROS 2006: a stylus in a pen-hold). Their
/// values depend on the grip force and spread over a factor of five; `light` and `firm` are two points within
/// it, not a measurement. With the arm's own 45 g and 0.1 N s/m they make the 145 g, 2.1 N s/m, 100 N/m and
/// the 545 g, 5.1 N s/m, 300 N/m that this project's stability tables use.
///
/// The correction stands for visual feedback, which needs some 200 ms: a person whose tool is held back
/// pushes harder until it is where it should be. It acts along the spindle, on depth, only: a burr's force is
/// mostly across its motion, so that pushing harder sideways moves the tool sideways to the push, and an
/// integral of the position error would drive the sway that the reference describes instead of stilling it
/// (s^2 + l s + 2 pi f l = 0 with l = K / (c_r +- i c_t) is unstable unless 2 pi f << |l| (c_r / c_t)^2).
/// Half a hertz keeps the firm grip's loop stable (b > m 2 pi f) by a factor of three. A person who feels a
/// wall does not push ever harder: max_push is the mean axial force of twelve dentists preparing crowns, 1.71
/// N, and half as much again, and less than the arm can hold against.
struct HandModel {
    double mass_kg = 0.0;
    double stiffness_n_per_mm = 0.0;
    double damping_n_s_per_mm = 0.0;
    double max_push_n = 2.6;
    double correction_hz = 0.5;          ///< 0: no correction
    double friction_compensation = 0.9;  ///< g
};

/// How the stylus is held. `firm` is the default of the programs: a dentist holds the handpiece in a pen grip
/// with the ring finger rested on a tooth, which is the stiffer of the two.
enum class Grip { light, firm };
/// Name for no hand at all: the stylus is guided, and no force holds it back.
inline constexpr const char* rails_name = "rails";

inline const char* name_of(std::optional<Grip> grip) {
    return !grip ? rails_name : *grip == Grip::light ? "light" : "firm";
}

inline HandModel hand_model(Grip grip) {
    switch (grip) {
        case Grip::light:
            return {.mass_kg = 0.1, .stiffness_n_per_mm = 0.1, .damping_n_s_per_mm = 0.002};
        case Grip::firm:
            break;
    }
    return {.mass_kg = 0.5, .stiffness_n_per_mm = 0.3, .damping_n_s_per_mm = 0.005};
}

}  // namespace osteomill
