#include "studies/stability/exact_motion.h"

#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

namespace osteomill::study {

MotionState ExactMotion::after(const MotionState& state, double force_n) const {
    const Eigen::Vector2d s =
        of_state * Eigen::Vector2d(state.position_m, state.velocity_m_per_s) + of_force * force_n;
    return {s(0), s(1)};
}

ExactMotion exact_motion(const HeldBody& body, double duration_s) {
    if (!(body.mass_kg > 0.0)) throw std::invalid_argument("exact motion: the body needs a mass");
    if (body.coulomb_friction_n != 0.0)
        throw std::invalid_argument("exact motion: Coulomb friction is not linear; switch it off");
    Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();  // of (x, v, u), u constant
    rate(0, 1) = 1.0;
    rate(1, 0) = -body.hand_stiffness_n_per_m / body.mass_kg;
    rate(1, 1) = -body.damping_n_s_per_m / body.mass_kg;
    rate(1, 2) = 1.0 / body.mass_kg;
    const Eigen::Matrix3d step = (rate * duration_s).exp();
    return {step.topLeftCorner<2, 2>(), step.topRightCorner<2, 1>()};
}

}  // namespace osteomill::study
