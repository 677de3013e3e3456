// The haptic arm in a hand, in three dimensions, as a scene of the stability map moves it: finely between
// ticks under a held force (BenchDevice), or in implicit substeps together with the bone (the truth).
//
//     m dv/dt = u + push + clamp(K (target - x), max_push) + B (v_target - v) - b v - friction
//
// mm, s, N. The target moves evenly. The hand is hand_and_arm.h's without its slow correction by eye, and
// without anyone who waits for the tool: it is valid for a few tenths of a second.
#pragma once

#include <glm/vec3.hpp>

#include "studies/stability/map/map_case.h"

namespace osteomill::study {

struct ToolMotion {
    glm::dvec3 position_mm{0.0};
    glm::dvec3 velocity_mm_per_s{0.0};
};

struct HeldTool {
    double mass_kg = 0.045;
    double arm_damping_n_s_per_mm = 0.0001;
    double hand_stiffness_n_per_mm = 0.0;
    double hand_damping_n_s_per_mm = 0.0;
    double max_push_n = 0.0;          ///< by the hand's spring
    double coulomb_friction_n = 0.0;  ///< 0: none
    /// It slides on a plane across z: its height stays, whatever pushes.
    bool is_guided_in_height = false;
};

/// The arm of hand_and_arm.h, without its Coulomb friction, in that grip. A bare arm has 0.5 N s/m and no
/// hand.
HeldTool held_tool(MapGrip grip);

/// Intended motion of the hand that holds the tool.
struct HandIntent {
    glm::dvec3 target_mm{0.0};  ///< at time 0
    glm::dvec3 velocity_mm_per_s{0.0};
    glm::dvec3 push_n{0.0};  ///< steady, beside the hand's spring
};

/// The intent that holds `motion` (at time 0) steady against `resistance_n` on the tool: the hand's target
/// runs ahead by what its spring must give, or somebody pushes a bare arm.
HandIntent steady_intent(const HeldTool& tool, const ToolMotion& motion, const glm::dvec3& resistance_n);

/// One substep under a force of the motors that is constant: implicit midpoint, as fine_motion.h, with the
/// hand's spring at the middle of the substep. Coulomb friction is an impulse of at most F h against the
/// motion that does not turn it round.
ToolMotion fine_step(const HeldTool& tool, const HandIntent& intent, const ToolMotion& motion, double time_s,
                     const glm::dvec3& motor_force_n, double substep_s);

/// A substep whose force is yet to be found: inertia * v(end) = drive + force(end), axis by axis. Backward
/// Euler, which stays exact in the limit of a damper that stops the tool within the substep. Without Coulomb
/// friction; a guide is an inertia that nothing moves.
struct OpenStep {
    glm::dvec3 inertia_n_s_per_mm{0.0};
    glm::dvec3 drive_n{0.0};
};
OpenStep open_step(const HeldTool& tool, const HandIntent& intent, const ToolMotion& motion, double time_s,
                   double substep_s);

}  // namespace osteomill::study
