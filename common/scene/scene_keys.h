// Plain keys of a scene's tables, each declared once: its name, its range and the value that an absent key
// stands for.
//
// A function below offers the keys of one table, in the order of a written file, to `keys`: to a TomlReader,
// which reads them; to the writer of scene files; or to a test, which holds docs/scenes.md against them. Keys
// whose presence itself means something (the source of a bone, the shape of a head, a tissue's strength) are
// not among them.
#pragma once

#include "common/scene/scene.h"
#include "common/scene/tissue_tables.h"

namespace osteomill::scene_keys {

// `Thing` is the setting to be read, or a constant one to be written. `usual` has the values of absent
// keys.

template <typename Keys, typename Thing>
void of_scene(Keys& keys, Thing&& scene, const Scene& usual) {
    keys.number("wall_friction", scene.wall_friction, usual.wall_friction, {0.0, 1.0});
    keys.number("force_scale", scene.force_scale, usual.force_scale, {0.1, 10.0});
}

template <typename Keys, typename Thing>
void of_tissue(Keys& keys, Thing&& tissue, const Tissue& usual) {
    keys.text("segment", tissue.segment);
    keys.truth("protected", tissue.is_protected, usual.is_protected);
    keys.number("warn_mm", tissue.warn_mm, usual_warn_mm(tissue.is_protected), {0.0, most_warn_mm});
    keys.number("opacity", tissue.opacity, usual.opacity, {0.0, 1.0});
    keys.number("shows_through_mm", tissue.shows_through_mm, usual_shows_through_mm(tissue.is_protected),
                {0.0, most_shows_through_mm});
    keys.number("shows_through_strength", tissue.shows_through_strength, usual.shows_through_strength,
                {0.0, 1.0});
}

/// Those that follow its strength.
template <typename Keys, typename Thing>
void of_tissue_under_burr(Keys& keys, Thing&& tissue, const Tissue& usual) {
    keys.number("stiffness_factor", tissue.stiffness_factor, usual.stiffness_factor, {0.01, 100.0});
    keys.truth("cuttable", tissue.is_cuttable, usual.is_cuttable);
}

template <typename Keys, typename Thing>
void of_burr(Keys& keys, Thing&& burr, const Burr& usual) {
    keys.whole_number("edges", burr.edges, usual.edges, 1, 64);
    keys.rpm("rpm", burr.spindle_rev_per_s, usual.spindle_rev_per_s, {100.0, 500'000.0});
    keys.vector("cutting_coefficients_n_per_mm2", burr.cutting_coefficients_n_per_mm2,
                usual.cutting_coefficients_n_per_mm2);
    keys.vector("edge_coefficients_n_per_mm", burr.edge_coefficients_n_per_mm,
                usual.edge_coefficients_n_per_mm);
    keys.choice("turns", burr.sense, usual.sense, spindle_sense_names);
    keys.number("run_out_mm", burr.run_out_mm, usual.run_out_mm, {0.0, 0.2});
}

template <typename Keys, typename Thing>
void of_motor(Keys& keys, Thing&& motor) {
    keys.needed_number("stall_torque_n_mm", motor.stall_torque_n_mm, {0.01, 10'000.0});
    keys.number("steady_torque_n_mm", motor.steady_torque_n_mm, 0.0, {0.0, 10'000.0});
}

template <typename Keys, typename Thing>
void of_coupling(Keys& keys, Thing&& scene, const Scene& usual) {
    keys.truth("feed_forward", scene.feed_forward, usual.feed_forward);
}

template <typename Keys, typename Thing>
void of_device(Keys& keys, Thing&& device, const DeviceMapping& usual) {
    keys.number("scale", device.scale, usual.scale, {0.01, 100.0});
    keys.place("offset_mm", device.offset_mm, usual.offset_mm);
}

template <typename Keys, typename Thing>
void of_start_pose(Keys& keys, Thing&& pose, const ToolPose& usual) {
    keys.place("position_mm", pose.position_mm, usual.position_mm);
    keys.direction("spindle_axis", pose.spindle_axis, usual.spindle_axis);
}

template <typename Keys, typename Thing>
void of_trajectory(Keys& keys, Thing&& trajectory, const TrajectorySpec& usual) {
    keys.place("start_mm", trajectory.start_mm, usual.start_mm);
    keys.direction("travel_direction", trajectory.travel_direction, usual.travel_direction);
    keys.number("speed_mm_per_s", trajectory.speed_mm_per_s, usual.speed_mm_per_s, {0.01, 500.0});
    keys.number("depth_mm", trajectory.depth_mm, usual.depth_mm, {0.01, 200.0});
    keys.number("width_mm", trajectory.width_mm, usual.width_mm, {0.01, 500.0});
}

template <typename Keys, typename Thing>
void of_plan(Keys& keys, Thing&& plan, const Plan& usual) {
    keys.number("margin_mm", plan.margin_mm, usual.margin_mm, {0.0, 500.0});
}

template <typename Keys, typename Thing>
void of_rating_item(Keys& keys, Thing&& item, const RatingItem& usual) {
    keys.number("points", item.points, usual.points, {0.01, most_rating_points});
}

/// `usual`: of its kind. Its path or its tissue is none of these.
template <typename Keys, typename Thing>
void of_fixture(Keys& keys, Thing&& fixture, const Fixture& usual) {
    keys.truth("on", fixture.is_on, usual.is_on);
    if (fixture.kind == FixtureKind::guide) {
        keys.number("radius_mm", fixture.radius_mm, usual.radius_mm, {0.0, 100.0});
        keys.number("reach_mm", fixture.reach_mm, usual.reach_mm, {0.1, 100.0});
    } else {
        keys.number("distance_mm", fixture.distance_mm, usual.distance_mm, {0.0, 10.0});
    }
    keys.number("fade_mm", fixture.fade_mm, usual.fade_mm, {0.05, 20.0});
    keys.number("damping_n_s_per_m", fixture.damping_n_s_per_m, usual.damping_n_s_per_m, {0.0, 1000.0});
    if (fixture.kind == FixtureKind::slow) {
        keys.number("spindle_share", fixture.spindle_share, usual.spindle_share, {0.1, 1.0});
    } else {
        keys.number("stiffness_n_per_mm", fixture.stiffness_n_per_mm, usual.stiffness_n_per_mm, {0.01, 20.0});
        keys.number("max_force_n", fixture.max_force_n, usual.max_force_n, {0.05, 20.0});
    }
}

}  // namespace osteomill::scene_keys
