// The motion of a linear body over a time during which the force on it is constant, without error:
//
//     s(t + h) = A s(t) + g u        s = (x, v)
//
// A and g are blocks of one matrix exponential of the continuous system (Van Loan, IEEE Trans. Automatic
// Control 23:395, 1978). What the linear verdicts rest on, and what the fine integrator is checked against.
#pragma once

#include <Eigen/Core>

#include "studies/stability/held_body.h"
#include "studies/stability/motion_state.h"

namespace osteomill::study {

struct ExactMotion {
    Eigen::Matrix2d of_state;
    Eigen::Vector2d of_force;

    MotionState after(const MotionState& state, double force_n) const;
};

/// Throws std::invalid_argument for a body with Coulomb friction, which is not linear, or without mass.
ExactMotion exact_motion(const HeldBody& body, double duration_s);

}  // namespace osteomill::study
