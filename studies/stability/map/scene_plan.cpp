#include "studies/stability/map/scene_plan.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "devices/simulated/hand_and_arm.h"
#include "simulation/coupling/coupling_spring.h"
#include "simulation/cutting_force/reference_force.h"

namespace osteomill::study {
namespace {

/// Off the lattice by an odd share of a voxel.
constexpr glm::dvec2 off_the_lattice_mm(0.031, 0.017);

void plan_cutting(const MapCase& c, ScenePlan& plan) {
    plan.burr.spindle_rev_per_s = c.spindle_rpm / 60.0;
    plan.depth_mm = c.depth_mm;
    plan.relative_stiffness = c.relative_stiffness;
    plan.burr_at_release_mm = {off_the_lattice_mm.x, off_the_lattice_mm.y,
                               plan.burr.radius_mm() - plan.depth_mm};

    SteadyMotion motion{
        .burr = plan.burr, .position_mm = plan.burr_at_release_mm, .velocity_mm_per_s = {1.0, 0.0, 0.0}};
    const Quadrature quadrature{.kappa = 120, .psi = 360};
    const auto force_n = [&] {
        return c.relative_stiffness * mean_reference_force_n(motion, flat_bone(), quadrature);
    };
    const glm::dvec3 force_n_s_per_mm = force_n();
    motion.burr.cutting_coefficients_n_per_mm2 = glm::dvec3(0.0);
    motion.burr.edge_coefficients_n_per_mm = {c.edge_n_per_mm, c.edge_n_per_mm, 0.0};
    const glm::dvec3 edge_force_n = c.edge_n_per_mm > 0.0 ? force_n() : glm::dvec3(0.0);
    plan.burr.edge_coefficients_n_per_mm = motion.burr.edge_coefficients_n_per_mm;
    const double left_n = most_steady_force_n - glm::length(edge_force_n);
    plan.feed_mm_per_s = std::min(most_feed_mm_per_s, left_n / glm::length(force_n_s_per_mm));
    plan.steady_force_n = plan.feed_mm_per_s * force_n_s_per_mm + edge_force_n;

    plan.at_release = {plan.burr_at_release_mm, {plan.feed_mm_per_s, 0.0, 0.0}};
    if (!plan.mount.is_rigid())
        plan.at_release.position_mm -= plan.steady_force_n / plan.mount.stiffness_n_per_mm;
    plan.intent = steady_intent(plan.tool, plan.at_release, plan.steady_force_n);
}

/// Released at the touch, and pushed on.
void plan_wall(const MapCase& c, ScenePlan& plan) {
    plan.wall_n_per_mm = c.wall_n_per_mm;
    plan.timing.settling = 500;
    plan.is_on_rail = c.grip == MapGrip::bare_arm;
    plan.burr_at_release_mm = {off_the_lattice_mm.x, off_the_lattice_mm.y, plan.burr.radius_mm()};
    const glm::dvec3 pushed_in_mm(0.0, 0.0, -wall_push_n / plan.wall_n_per_mm);
    plan.intent = steady_intent(plan.tool, {plan.burr_at_release_mm + pushed_in_mm, glm::dvec3(0.0)},
                                {0.0, 0.0, wall_push_n});
    plan.at_release = {plan.burr_at_release_mm, {0.0, 0.0, -touch_mm_per_s}};
}

}  // namespace

Mount mount_of(const MapCase& c) {
    const bool has_spring = c.method == "implicit" || c.method == "virtual-coupling";
    if (!has_spring) return {};
    const DeviceLimits arm = limits_of(ArmModel{});
    return {.stiffness_n_per_mm = c.scene == MapScene::wall ? c.wall_n_per_mm : arm.max_stiffness_n_per_mm,
            .damping_n_s_per_mm = arm.damping_n_s_per_mm};
}

ScenePlan plan_of(const MapCase& c) {
    ScenePlan plan{.scene = c.scene, .tool = held_tool(c.grip), .mount = mount_of(c)};
    if (!c.is_ideal_device) plan.tool.coulomb_friction_n = ArmModel{}.coulomb_friction_n;
    if (c.scene == MapScene::cutting) {
        // Nothing but a hand holds a burr at its depth: under a steady push it would climb out of a shallow
        // slot by itself. So a bare arm slides on a plane.
        plan.tool.is_guided_in_height = c.grip == MapGrip::bare_arm;
        plan_cutting(c, plan);
    } else {
        plan_wall(c, plan);
    }
    return plan;
}

double rendered_spring_n_per_mm(const ScenePlan& plan) {
    if (plan.scene == MapScene::cutting) return plan.mount.stiffness_n_per_mm;
    return plan.wall_n_per_mm;
}

glm::dvec3 guided_position_mm(const ScenePlan& plan, std::size_t ticks_before_release) {
    const double before_s = tick_s * static_cast<double>(ticks_before_release);
    const glm::dvec3 at_speed_mm = plan.at_release.position_mm - before_s * plan.at_release.velocity_mm_per_s;
    const std::size_t ticks = plan.timing.guided - std::min(plan.timing.guided, ticks_before_release);
    if (plan.scene == MapScene::wall || ticks >= plan.timing.ramp) return at_speed_mm;

    // Smoothly from rest: the share of full speed and force is s = 3 u^2 - 2 u^3, its integral u^3 - u^4 / 2.
    const double ramp_s = tick_s * static_cast<double>(plan.timing.ramp);
    const double u = static_cast<double>(ticks) / static_cast<double>(plan.timing.ramp);
    const double share = u * u * (3.0 - 2.0 * u);
    const double still_to_go_s = ramp_s * (0.5 - u * u * u * (1.0 - 0.5 * u));
    const double at_speed_s = tick_s * static_cast<double>(plan.timing.guided - plan.timing.ramp);
    const glm::dvec3 lead_mm = plan.at_release.position_mm - plan.burr_at_release_mm;
    return plan.burr_at_release_mm + share * lead_mm -
           (at_speed_s + still_to_go_s) * plan.at_release.velocity_mm_per_s;
}

}  // namespace osteomill::study
