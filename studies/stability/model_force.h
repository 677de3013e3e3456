// Force that a model computes at its samples: a wall that is there on both sides, or a damper, or both.
//
//     F_n = K x_n + B (x_n - x_{n-1}) / (N T)
//
// as a sampled model can: the velocity is the difference of two positions (Colgate and Schenkel, J. Robotic
// Systems 14:37, 1997). F is the resistance; the force on the device is its opposite.
#pragma once

namespace osteomill::study {

struct ModelForce {
    double stiffness_n_per_m = 0.0;
    double damping_n_s_per_m = 0.0;

    double resistance_n(double position_m, double previous_m, double period_s) const {
        return stiffness_n_per_m * position_m + damping_n_s_per_m * (position_m - previous_m) / period_s;
    }
};

inline ModelForce wall(double stiffness_n_per_m) {
    return {.stiffness_n_per_m = stiffness_n_per_m};
}
inline ModelForce damper(double damping_n_s_per_m) {
    return {.damping_n_s_per_m = damping_n_s_per_m};
}

}  // namespace osteomill::study
