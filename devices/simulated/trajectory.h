// The motion that a simulated hand means to make: a function of time, linear between waypoints. Patient
// space.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

struct Waypoint {
    double time_s = 0.0;
    ToolPose pose;                      ///< of the burr's centre, patient LPS
    bool pedal = false;                 ///< from this waypoint on
    std::optional<std::size_t> burr{};  ///< from this waypoint on; nullopt: as before
};

struct TrajectorySample {
    ToolPose target;
    bool pedal = false;
    std::optional<std::size_t> burr;
};

class Trajectory {
  public:
    /// Throws std::invalid_argument, naming the waypoint, unless there is one, times ascend strictly, all
    /// values are finite and axes are of unit length.
    explicit Trajectory(std::vector<Waypoint> waypoints);

    /// Before the first waypoint and after the last the tool rests there; after the last with the pedal up.
    /// A waypoint that is due within `rounding_s` is reached, exactly. Real-time safe.
    TrajectorySample at(double time_s, double rounding_s = 0.0) const noexcept;

    /// When the last waypoint is reached; infinite for a trajectory of a single one, which just holds.
    double duration_s() const noexcept;

    const std::vector<Waypoint>& waypoints() const { return waypoints_; }

  private:
    std::vector<Waypoint> waypoints_;
};

/// The trajectory that a scene asks for: built in, or from a CSV file. `burrs` are the
/// scene's; `start_pose` is where the tool rests first, and its spindle axis is kept by the built-in motions.
/// Throws std::invalid_argument or, for a file, std::runtime_error.
Trajectory make_trajectory(const TrajectorySpec& spec, const ToolPose& start_pose,
                           const std::vector<Burr>& burrs, std::size_t start_burr);

// The motions that code makes, as waypoints. Lengths and frames as in TrajectorySpec (patient LPS, mm); the
// spindle axis is the start pose's.

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

// Trajectories from CSV files, patient LPS:
//
//     t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal[,burr]
//     0.0,25.0,25.0,12.0,0,0,1,0
//
// The first line must be this header, with or without `burr` (index into the scene's set). Times ascend. The
// axis points from the tip to the shank and is normalised here. `pedal` is 0 or 1. Blank lines and lines that
// begin with # are skipped (one may name an arm: written_pose.h). Anything else is refused with file
// and line.

/// Throws std::runtime_error with one line: file, line, what is wrong, what would be right.
std::vector<Waypoint> read_trajectory_csv(const std::filesystem::path& file, std::size_t burr_count);
/// The trajectory in a text; `name` stands for the file in errors.
std::vector<Waypoint> read_trajectory_csv(const std::string& text, const std::string& name,
                                          std::size_t burr_count);

}  // namespace osteomill
