// A haptic device and the hand on it, in one dimension, on which the sampled force acts.
//
//     m dv/dt = -b v - k x - friction + u        x from where the hand's spring is at rest
//
// SI units throughout the bench (m, kg, s, N), since the known results are stated in N/m and N s/m.
#pragma once

#include "devices/simulated/hand_and_arm.h"

namespace osteomill::testing {

struct HeldBody {
    double mass_kg = 0.045;
    double damping_n_s_per_m = 0.1;
    double hand_stiffness_n_per_m = 0.0;  ///< spring to the place where the hand means to be; 0: nobody holds
                                          ///< it
    double coulomb_friction_n = 0.0;      ///< 0: the body is linear
};

/// The arm alone, without its Coulomb friction and with the viscous friction given.
inline HeldBody bare_arm(double damping_n_s_per_m) {
    return {.mass_kg = ArmModel{}.mass_kg, .damping_n_s_per_m = damping_n_s_per_m};
}

/// The arm in a hand, without the arm's Coulomb friction: arm and hand move as one mass.
inline HeldBody arm_in_hand(Grip grip) {
    const ArmModel arm;
    const HandModel hand = hand_model(grip);
    constexpr double mm_per_m = 1000.0;
    return {.mass_kg = arm.mass_kg + hand.mass_kg,
            .damping_n_s_per_m = mm_per_m * (arm.damping_n_s_per_mm + hand.damping_n_s_per_mm),
            .hand_stiffness_n_per_m = mm_per_m * hand.stiffness_n_per_mm};
}

/// Position and velocity of a body in one dimension.
struct MotionState {
    double position_m = 0.0;
    double velocity_m_per_s = 0.0;
};

}  // namespace osteomill::testing
