// The physical damping that a device needs so that the sampled force on it takes more than it gives, whatever
// the hand does (Colgate and Schenkel, J. Robotic Systems 14:37, 1997), at the haptic rate:
//
//     b > T / (2 (1 - cos wT)) Re{(1 - e^-jwT) H(e^jwT)}   for all w in 0 .. pi/T
//
// H is the resistance over the position. For a wall and a damper under a hold: b > K T / 2 + |B|, where a
// negative B is worst slowly and a positive one at the Nyquist frequency.
#pragma once

#include "studies/stability/linear_hold.h"
#include "studies/stability/model_force.h"

namespace osteomill::study {

/// At one frequency, given as the angle w T from one tick to the next, 0 < angle <= pi. Throws
/// std::invalid_argument for a hold of more than one tick, to which this does not apply.
double needed_damping_n_s_per_m(const ModelForce& model, const LinearHold& hold, double tick_s, double angle);

struct WorstFrequency {
    double angle = 0.0;
    double needed_damping_n_s_per_m = 0.0;
};

/// Over frequencies from pi/1000 per tick to Nyquist.
WorstFrequency worst_frequency(const ModelForce& model, const LinearHold& hold, double tick_s);

}  // namespace osteomill::study
