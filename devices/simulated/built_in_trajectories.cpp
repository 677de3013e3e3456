#include "devices/simulated/built_in_trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

namespace osteomill {

namespace {

/// Greatest distance between waypoints: circles are round to a thousandth of a millimetre.
constexpr double waypoint_spacing_mm = 0.1;

/// Lays waypoints one after the other, each at a speed from the last.
class Path {
  public:
    explicit Path(const ToolPose& start) { waypoints_.push_back({0.0, start, false, std::nullopt}); }

    void move_to(const glm::dvec3& position_mm, double speed_mm_per_s) {
        const double distance_mm = glm::distance(position_mm, waypoints_.back().pose.position_mm);
        if (distance_mm == 0.0) return;
        append({position_mm, waypoints_.back().pose.spindle_axis}, distance_mm / speed_mm_per_s);
    }
    void wait(double duration_s) { append(waypoints_.back().pose, duration_s); }
    void append(const ToolPose& pose, double after_s) {
        waypoints_.push_back({waypoints_.back().time_s + after_s, pose, pedal_, std::nullopt});
    }
    void press_pedal(bool down) {
        pedal_ = down;
        waypoints_.back().pedal = down;
    }
    /// From the start pose to a point above the bone, where the spindle starts.
    void approach(const glm::dvec3& above_bone_mm) {
        wait(settle_s);
        move_to(above_bone_mm, approach_mm_per_s);
        press_pedal(true);
        wait(settle_s);
    }
    /// To a point above the bone, where the spindle stops.
    void withdraw(const glm::dvec3& above_bone_mm, double speed_mm_per_s) {
        move_to(above_bone_mm, speed_mm_per_s);
        press_pedal(false);
        wait(settle_s);
    }

    std::vector<Waypoint> take() && { return std::move(waypoints_); }

  private:
    std::vector<Waypoint> waypoints_;
    bool pedal_ = false;
};

void require_positive(double value, const char* name) {
    if (!(std::isfinite(value) && value > 0.0)) {
        throw std::invalid_argument(fmt::format("trajectory: {} is {}, must be positive", name, value));
    }
}

/// Some unit vector across a unit vector.
glm::dvec3 perpendicular_to(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(other - glm::dot(other, axis) * axis);
}

void require_valid(const TrajectorySpec& spec) {
    require_positive(spec.speed_mm_per_s, "speed_mm_per_s");
    require_positive(spec.depth_mm, "depth_mm");
    require_positive(spec.width_mm, "width_mm");
}

}  // namespace

std::vector<Waypoint> hold_waypoints(const ToolPose& start_pose) {
    return {{0.0, start_pose, false, std::nullopt}};
}

std::vector<Waypoint> polishing_waypoints(const TrajectorySpec& spec, const ToolPose& start_pose,
                                          const Burr& burr) {
    require_valid(spec);
    const glm::dvec3 up = start_pose.spindle_axis;
    const glm::dvec3 in_surface = spec.travel_direction - glm::dot(spec.travel_direction, up) * up;
    if (!(glm::length(in_surface) > 1e-6)) {
        throw std::invalid_argument("trajectory: travel_direction must not lie along the spindle");
    }
    const glm::dvec3 along = glm::normalize(in_surface);
    const glm::dvec3 across = glm::cross(up, along);
    const double travel_mm = std::max(polishing_travel_mm, spec.width_mm);

    const auto centre_at = [&](double way_mm) {
        const double in_cycle_mm = std::fmod(way_mm, 2.0 * spec.width_mm);
        const double slide_mm = std::min(in_cycle_mm, 2.0 * spec.width_mm - in_cycle_mm);
        const double depth_mm = spec.depth_mm * way_mm / travel_mm;
        return spec.start_mm + slide_mm * along + (burr.radius_mm() - depth_mm) * up;
    };
    // Two sines of unrelated frequency: no repetition within a slide, no random numbers.
    const auto waver = [](double t_s, double hz) {
        const double phase = 2.0 * std::numbers::pi * hz * t_s;
        return 0.6 * std::sin(phase) + 0.4 * std::sin(std::numbers::sqrt3 * phase + 1.0);
    };

    Path path(start_pose);
    path.approach(centre_at(0.0) + clearance_mm * up);
    path.move_to(centre_at(0.0), spec.speed_mm_per_s);
    double time_s = 0.0;
    for (double way_mm = 0.0; way_mm < travel_mm;) {
        const double step_mm = std::min(waypoint_spacing_mm, travel_mm - way_mm);
        const double step_s =
            step_mm / (spec.speed_mm_per_s * (1.0 + polishing_speed_waver * waver(time_s, 0.4)));
        way_mm = step_mm < waypoint_spacing_mm ? travel_mm : way_mm + step_mm;
        time_s += step_s;
        const glm::dvec3 axis = glm::normalize(
            up + polishing_tilt_waver_rad * (waver(time_s, 0.5) * along + waver(time_s, 0.7) * across));
        path.append({centre_at(way_mm), axis}, step_s);
    }
    path.withdraw(centre_at(travel_mm) + (spec.depth_mm + clearance_mm) * up, spec.speed_mm_per_s);
    return std::move(path).take();
}

std::vector<Waypoint> cavity_waypoints(const TrajectorySpec& spec, const ToolPose& start_pose,
                                       const Burr& burr) {
    require_valid(spec);
    if (burr.diameter_mm > spec.width_mm) {
        throw std::invalid_argument(
            fmt::format("trajectory: a burr of {} mm does not fit into a cavity of width_mm = {}",
                        burr.diameter_mm, spec.width_mm));
    }
    const glm::dvec3 up = start_pose.spindle_axis;
    const glm::dvec3 right = perpendicular_to(up);
    const glm::dvec3 forward = glm::cross(up, right);
    const double widest_mm = 0.5 * (spec.width_mm - burr.diameter_mm);
    const auto centre_at = [&](double radius_mm, double angle_rad, double depth_mm) {
        return spec.start_mm + radius_mm * (std::cos(angle_rad) * right + std::sin(angle_rad) * forward) +
               (burr.radius_mm() - depth_mm) * up;
    };

    const auto turns = std::ceil(widest_mm / (cavity_turn_diameters * burr.diameter_mm));
    const auto layers = std::ceil(spec.depth_mm / (cavity_layer_diameters * burr.diameter_mm));
    const glm::dvec3 above_mm = centre_at(0.0, 0.0, -clearance_mm);

    Path path(start_pose);
    path.approach(above_mm);
    for (double layer = 1.0; layer <= layers; layer += 1.0) {
        const double depth_mm = spec.depth_mm * layer / layers;
        path.move_to(centre_at(0.0, 0.0, depth_mm), cavity_plunge_share * spec.speed_mm_per_s);
        if (widest_mm == 0.0) continue;
        // Outward in `turns` turns, then once around along the wall.
        for (double angle = 0.0; angle < 2.0 * std::numbers::pi * (turns + 1.0);) {
            const double spiral = angle / (2.0 * std::numbers::pi * turns);
            const double radius_mm = widest_mm * std::min(1.0, spiral);
            path.move_to(centre_at(radius_mm, angle, depth_mm), spec.speed_mm_per_s);
            angle += std::min(0.3, waypoint_spacing_mm / std::max(radius_mm, 1e-3));
        }
        path.move_to(centre_at(widest_mm, 0.0, depth_mm), spec.speed_mm_per_s);
        path.move_to(centre_at(0.0, 0.0, depth_mm), spec.speed_mm_per_s);
    }
    path.withdraw(above_mm, spec.speed_mm_per_s);
    return std::move(path).take();
}

}  // namespace osteomill
