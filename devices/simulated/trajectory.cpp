#include "devices/simulated/trajectory.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "devices/simulated/built_in_trajectories.h"
#include "devices/simulated/csv_trajectory.h"

namespace osteomill {

namespace {

void require_valid(const Waypoint& waypoint, std::size_t index) {
    const auto& [position, axis] = waypoint.pose;
    const std::string name = "trajectory: waypoint " + std::to_string(index);
    if (!std::isfinite(waypoint.time_s) || !std::isfinite(glm::length(position))) {
        throw std::invalid_argument(name + " is not finite");
    }
    if (!(std::abs(glm::length(axis) - 1.0) < 1e-6)) {
        throw std::invalid_argument(name + " has a spindle axis that is not of unit length");
    }
}

}  // namespace

Trajectory::Trajectory(std::vector<Waypoint> waypoints) : waypoints_(std::move(waypoints)) {
    if (waypoints_.empty()) throw std::invalid_argument("trajectory: needs at least one waypoint");
    for (std::size_t i = 0; i < waypoints_.size(); ++i) {
        require_valid(waypoints_[i], i);
        if (i > 0 && !(waypoints_[i].time_s > waypoints_[i - 1].time_s)) {
            throw std::invalid_argument("trajectory: waypoint " + std::to_string(i) +
                                        " does not come later than the one before");
        }
        if (i > 0 && !waypoints_[i].burr) waypoints_[i].burr = waypoints_[i - 1].burr;
    }
}

TrajectorySample Trajectory::at(double time_s, double rounding_s) const noexcept {
    const auto after = std::upper_bound(waypoints_.begin(), waypoints_.end(), time_s + rounding_s,
                                        [](double t, const Waypoint& w) { return t < w.time_s; });
    if (after == waypoints_.begin()) return {after->pose, false, after->burr};
    const Waypoint& from = *(after - 1);
    if (after == waypoints_.end()) return {from.pose, from.pedal && waypoints_.size() == 1, from.burr};

    if (std::abs(time_s - from.time_s) <= rounding_s) return {from.pose, from.pedal, from.burr};
    const double share = (time_s - from.time_s) / (after->time_s - from.time_s);
    const glm::dvec3 axis = glm::mix(from.pose.spindle_axis, after->pose.spindle_axis, share);
    const double length = glm::length(axis);
    return {{glm::mix(from.pose.position_mm, after->pose.position_mm, share),
             length > 1e-6 ? axis / length : from.pose.spindle_axis},
            from.pedal,
            from.burr};
}

double Trajectory::duration_s() const noexcept {
    return waypoints_.size() == 1 ? std::numeric_limits<double>::infinity() : waypoints_.back().time_s;
}

Trajectory make_trajectory(const TrajectorySpec& spec, const ToolPose& start_pose,
                           const std::vector<Burr>& burrs, std::size_t start_burr) {
    if (const auto* file = std::get_if<std::filesystem::path>(&spec.source)) {
        return Trajectory(read_trajectory_csv(*file, burrs.size()));
    }
    switch (std::get<BuiltInTrajectory>(spec.source)) {
        case BuiltInTrajectory::polishing:
            return Trajectory(polishing_waypoints(spec, start_pose, burrs.at(start_burr)));
        case BuiltInTrajectory::cavity:
            return Trajectory(cavity_waypoints(spec, start_pose, burrs.at(start_burr)));
        case BuiltInTrajectory::hold:
            break;
    }
    return Trajectory(hold_waypoints(start_pose));
}

}  // namespace osteomill
