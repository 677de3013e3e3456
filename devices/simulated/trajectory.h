// The motion that a simulated hand means to make: a function of time, linear between waypoints. Patient
// space.
#pragma once

#include <optional>
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

/// The trajectory that a scene asks for: built in, or from a CSV file (csv_trajectory.h). `burrs` are the
/// scene's; `start_pose` is where the tool rests first, and its spindle axis is kept by the built-in motions.
/// Throws std::invalid_argument or, for a file, std::runtime_error.
Trajectory make_trajectory(const TrajectorySpec& spec, const ToolPose& start_pose,
                           const std::vector<Burr>& burrs, std::size_t start_burr);

}  // namespace osteomill
