#include "studies/stability/map/held_tool.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "devices/simulated/hand_and_arm.h"

namespace osteomill::study {
namespace {

constexpr double mm_per_m = 1000.0;
/// A million times an arm's value in a substep.
constexpr double guided_inertia_n_s_per_mm = 1e6;

/// The hand's force on the tool half a substep ahead, without the terms that depend on the tool's velocity.
glm::dvec3 hand_force_n(const HeldTool& tool, const HandIntent& intent, const ToolMotion& motion,
                        double time_s, double substep_s) {
    const double middle_s = time_s + 0.5 * substep_s;
    const glm::dvec3 error_mm = intent.target_mm + middle_s * intent.velocity_mm_per_s - motion.position_mm -
                                0.5 * substep_s * motion.velocity_mm_per_s;
    glm::dvec3 spring_n = tool.hand_stiffness_n_per_mm * error_mm;
    const double size_n = glm::length(spring_n);
    if (size_n > tool.max_push_n) spring_n *= tool.max_push_n / size_n;
    return spring_n + intent.push_n + tool.hand_damping_n_s_per_mm * intent.velocity_mm_per_s;
}

double damping_n_s_per_mm(const HeldTool& tool) {
    return tool.arm_damping_n_s_per_mm + tool.hand_damping_n_s_per_mm;
}

}  // namespace

HeldTool held_tool(MapGrip grip) {
    const ArmModel arm;
    if (grip == MapGrip::bare_arm) return {.mass_kg = arm.mass_kg, .arm_damping_n_s_per_mm = 0.0005};
    const HandModel hand = hand_model(grip == MapGrip::light ? Grip::light : Grip::firm);
    return {.mass_kg = arm.mass_kg + hand.mass_kg,
            .arm_damping_n_s_per_mm = arm.damping_n_s_per_mm,
            .hand_stiffness_n_per_mm = hand.stiffness_n_per_mm,
            .hand_damping_n_s_per_mm = hand.damping_n_s_per_mm,
            .max_push_n = hand.max_push_n};
}

HandIntent steady_intent(const HeldTool& tool, const ToolMotion& motion, const glm::dvec3& resistance_n) {
    const glm::dvec3 velocity = motion.velocity_mm_per_s;
    const double speed = glm::length(velocity);
    glm::dvec3 needed_n = tool.arm_damping_n_s_per_mm * velocity - resistance_n;
    if (speed > 0.0) needed_n += tool.coulomb_friction_n / speed * velocity;
    HandIntent intent{.target_mm = motion.position_mm, .velocity_mm_per_s = velocity};
    if (tool.hand_stiffness_n_per_mm > 0.0) {
        intent.target_mm += needed_n / tool.hand_stiffness_n_per_mm;
    } else {
        intent.push_n = needed_n;
    }
    return intent;
}

ToolMotion fine_step(const HeldTool& tool, const HandIntent& intent, const ToolMotion& motion, double time_s,
                     const glm::dvec3& motor_force_n, double substep_s) {
    const double inertia = 2.0 * tool.mass_kg / (mm_per_m * substep_s);
    const glm::dvec3 force_n = motor_force_n + hand_force_n(tool, intent, motion, time_s, substep_s);
    const glm::dvec3 before = motion.velocity_mm_per_s;
    const glm::dvec3 middle = (inertia * before + force_n) / (inertia + damping_n_s_per_mm(tool));
    glm::dvec3 after = 2.0 * middle - before;
    if (tool.coulomb_friction_n > 0.0) {
        const double speed = glm::length(after);
        const double friction_mm_per_s = 2.0 * tool.coulomb_friction_n / inertia;
        after = speed <= friction_mm_per_s ? glm::dvec3(0.0) : after * (1.0 - friction_mm_per_s / speed);
    }
    if (tool.is_guided_in_height) after.z = before.z;
    return {motion.position_mm + 0.5 * substep_s * (before + after), after};
}

OpenStep open_step(const HeldTool& tool, const HandIntent& intent, const ToolMotion& motion, double time_s,
                   double substep_s) {
    const double inertia = tool.mass_kg / (mm_per_m * substep_s);
    OpenStep step{.inertia_n_s_per_mm = glm::dvec3(inertia + damping_n_s_per_mm(tool)),
                  .drive_n = inertia * motion.velocity_mm_per_s +
                             hand_force_n(tool, intent, motion, time_s, substep_s)};
    if (tool.is_guided_in_height) {
        step.inertia_n_s_per_mm.z = guided_inertia_n_s_per_mm;
        step.drive_n.z = guided_inertia_n_s_per_mm * motion.velocity_mm_per_s.z;
    }
    return step;
}

}  // namespace osteomill::study
