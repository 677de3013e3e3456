// The work that a hand does which moves a damped device along given positions, against a sampled force.
//
// Between ticks the hand moves straight and evenly: of all motions through the same positions that is the one
// that loses the least in the device's damper (b d^2 / T per tick), hence the one that shows whether the rest
// gives energy. In this worst case Colgate's condition is sharp; for a sinusoid between the ticks it is not.
#pragma once

#include <span>

#include "studies/stability/linear_hold.h"
#include "studies/stability/model_force.h"

namespace osteomill::study {

struct GuidedWork {
    double lost_in_damper_j = 0.0;  ///< never negative
    double taken_by_force_j = 0.0;  ///< by the ledger
    double by_hand_j() const { return lost_in_damper_j + taken_by_force_j; }
};

/// One position a haptic tick, from rest at the origin. The device's mass does not matter where the motion
/// comes back to rest.
GuidedWork guided_work(std::span<const double> positions_m, double damping_n_s_per_m, const ModelForce& model,
                       const LinearHold& hold, double tick_s);

}  // namespace osteomill::study
