// A device under a held model force as one linear map from model sample to model sample ("lifted": all haptic
// ticks of a model period together), and whether it is stable: all eigenvalues inside the unit circle.
//
//     state = (x, v, x_{n-1}, x_{n-2}, ...)     as many old samples as the hold and the model's velocity
//     reach back
#pragma once

#include <Eigen/Core>

#include "studies/stability/held_body.h"
#include "studies/stability/linear_hold.h"
#include "studies/stability/model_force.h"

namespace osteomill::study {

/// Over one model period. Between ticks the motion is exact. Throws as exact_motion does.
Eigen::MatrixXd lifted_system(const HeldBody& body, const ModelForce& model, const LinearHold& hold,
                              double tick_s);

/// The largest magnitude of an eigenvalue: by what the slowest-dying motion is multiplied at each step.
double spectral_radius(const Eigen::MatrixXd& step);

/// A body that nothing holds in place keeps an eigenvalue of 1 and is called unstable: give it a spring.
bool is_stable(const HeldBody& body, const ModelForce& model, const LinearHold& hold, double tick_s);

}  // namespace osteomill::study
