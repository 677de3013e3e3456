// The motions that code makes, as waypoints. Lengths and frames as in TrajectorySpec (patient LPS, mm); the
// spindle axis is the start pose's.
#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "devices/simulated/trajectory.h"

namespace osteomill {

/// Speed through free air, from the start pose to above the bone.
inline constexpr double approach_mm_per_s = 15.0;
/// Gap between the burr and the bone while the spindle starts and after it has stopped.
inline constexpr double clearance_mm = 1.0;
/// Time from the press of the pedal until the burr moves on to the bone, and for which the tool rests at the
/// end.
inline constexpr double settle_s = 0.3;

/// The tool rests at a pose, pedal up.
std::vector<Waypoint> hold_waypoints(const ToolPose& start_pose);

/// The published experiment: the burr slides along the surface, `width_mm` to and fro, and sinks in
/// proportion to its travel, until after `polishing_travel_mm` its lowest point is `depth_mm` below the
/// surface. Tilt and speed waver, as a person's do. A slide as long as the travel is a single stroke.
inline constexpr double polishing_travel_mm = 40.0;
inline constexpr double polishing_tilt_waver_rad = 0.05;  ///< about 3 degrees
inline constexpr double polishing_speed_waver = 0.15;     ///< share of the speed
std::vector<Waypoint> polishing_waypoints(const TrajectorySpec& spec, const ToolPose& start_pose,
                                          const Burr& burr);

/// Clears a round hole, `width_mm` wide and `depth_mm` deep (the burr's lowest point), layer by layer: sinks
/// in at the centre along the spindle, spirals outward, closes with a full circle along the wall, returns to
/// the centre; at the end it withdraws. Throws std::invalid_argument if the burr is wider than the hole.
std::vector<Waypoint> cavity_waypoints(const TrajectorySpec& spec, const ToolPose& start_pose,
                                       const Burr& burr);
/// Depth of a layer and distance between turns of the spiral, as shares of the burr's diameter. Turns half a
/// radius apart leave no ridges between them.
inline constexpr double cavity_layer_diameters = 0.4;
inline constexpr double cavity_turn_diameters = 0.4;
/// Speed of sinking in, as a share of the speed along the spiral: at its tip the burr hardly cuts.
inline constexpr double cavity_plunge_share = 0.25;

}  // namespace osteomill
