// The hand that holds the arm: a mass on a spring and a damper, pulled towards the intended position of the
// tool, and a slow correction of that intent by eye.
//
//     F_hand = K (x_target + c - x) + B (v_target - v) + g F_f u    |K (...)| <= max_push
//     dc/dt  = 2 pi f a a^T (x_target - x)                     f = correction_hz, a = spindle axis
//
// u points along v_target: a hand used to its arm adds the share g of the friction F_f to its push. Without
// this the tool trails a light hand by a millimetre and cuts corners.
//
// Sources. The form, a second-order lump, is that of Hajian and Howe (J. Biomech. Eng. 119:109, 1997: the
// finger in extension, a few hundred N/m, 2 to 7 N s/m, a few grams), Kuchenbecker, Park and Niemeyer (ASME
// IMECE 2003: the wrist around a stylus) and Israr, Choi and Tan (IROS 2006: a stylus in a pen-hold). Their
// values depend on the grip force and spread over a factor of five; `light` and `firm` are two points within
// it, not a measurement. With the arm's own 45 g and 0.1 N s/m they make the 145 g, 2.1 N s/m, 100 N/m and
// the 545 g, 5.1 N s/m, 300 N/m that this project's stability tables use.
//
// The correction stands for visual feedback, which needs some 200 ms: a person whose tool is held back pushes
// harder until it is where it should be. It acts along the spindle, on depth, only: a burr's force is mostly
// across its motion, so that pushing harder sideways moves the tool sideways to the push, and an integral of
// the position error would drive the sway that the reference describes instead of stilling it (s^2 + l s +
// 2 pi f l = 0 with l = K / (c_r +- i c_t) is unstable unless 2 pi f << |l| (c_r / c_t)^2). Half a hertz
// keeps the firm grip's loop stable (b > m 2 pi f) by a factor of three. A person who feels a wall does not
// push ever harder: max_push is the mean axial force of twelve dentists preparing crowns, 1.71 N, and half as
// much again, and less than the arm can hold against.
#pragma once

#include <optional>
#include <string>

namespace osteomill {

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
