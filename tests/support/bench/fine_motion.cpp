#include "tests/support/bench/fine_motion.h"

#include <cmath>

namespace osteomill::testing {
namespace {

/// Mean velocity of a substep under a force: m (2 v_mid - 2 v) / h = F - b v_mid - k (x + h v_mid / 2).
double mid_velocity(const HeldBody& body, const MotionState& state, double force_n, double substep_s) {
    const double inertia = 2.0 * body.mass_kg / substep_s;
    return (inertia * state.velocity_m_per_s + force_n - body.hand_stiffness_n_per_m * state.position_m) /
           (inertia + body.damping_n_s_per_m + 0.5 * body.hand_stiffness_n_per_m * substep_s);
}

MotionState moved(const MotionState& state, double mid_velocity_m_per_s, double substep_s) {
    return {state.position_m + mid_velocity_m_per_s * substep_s,
            2.0 * mid_velocity_m_per_s - state.velocity_m_per_s};
}

}  // namespace

MotionState fine_step(const HeldBody& body, const MotionState& state, double force_n, double substep_s) {
    const double friction_n = body.coulomb_friction_n;
    if (friction_n == 0.0) return moved(state, mid_velocity(body, state, force_n, substep_s), substep_s);

    const double v = state.velocity_m_per_s;
    const double drive_n = force_n - body.hand_stiffness_n_per_m * state.position_m;
    if (v == 0.0 && std::abs(drive_n) <= friction_n) return state;

    const double sense = std::copysign(1.0, v != 0.0 ? v : drive_n);
    const MotionState next =
        moved(state, mid_velocity(body, state, force_n - sense * friction_n, substep_s), substep_s);
    if (next.velocity_m_per_s * sense >= 0.0) return next;
    const double until_rest_s = substep_s * v / (v - next.velocity_m_per_s);
    return {state.position_m + 0.5 * v * until_rest_s, 0.0};
}

}  // namespace osteomill::testing
