#include "devices/simulated/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/bone/patient_space.h"
#include "common/files/input_file.h"
#include "common/session/session_control.h"
#include "common/session/written_pose.h"
#include "common/text/csv.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"

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

namespace {

constexpr std::size_t columns_without_burr = 8;

class CsvReader {
  public:
    CsvReader(const std::string& text, const std::string& name, std::size_t burr_count)
        : lines_(text, name), name_(name), burr_count_(burr_count) {}

    std::vector<Waypoint> read() {
        read_header();
        std::vector<Waypoint> waypoints;
        while (lines_.next()) {
            waypoints.push_back(waypoint());
            if (waypoints.size() > 1 && !(waypoints.back().time_s > waypoints[waypoints.size() - 2].time_s)) {
                lines_.fail("t_s must be later than on the line before");
            }
        }
        if (waypoints.empty()) throw std::runtime_error(name_ + ": no waypoint after the header line");
        return waypoints;
    }

  private:
    void read_header() {
        const std::string with_burr = fmt::format("{}{}", trajectory_columns, trajectory_burr_column);
        const std::string header = lines_.next() ? lines_.line() : "";
        has_burr_ = header == with_burr;
        if (header == trajectory_columns || has_burr_) return;
        lines_.fail(fmt::format("the first line must be {}[{}]", trajectory_columns, trajectory_burr_column));
    }

    Waypoint waypoint() {
        const std::vector<std::string> cells = split();
        const auto number = [&](std::size_t column) { return to_number(cells[column]); };
        Waypoint result;
        result.time_s = number(0);
        if (!(std::abs(result.time_s) <= longest_session_s))
            lines_.fail(fmt::format("t_s must be within {:.0f} s", longest_session_s));
        result.pose.position_mm = {number(1), number(2), number(3)};
        if (!is_place(result.pose.position_mm))
            lines_.fail(fmt::format("x_mm,y_mm,z_mm lie more than {} mm from the origin", farthest_place_mm));
        const auto axis = unit_direction({number(4), number(5), number(6)});
        if (!axis)
            lines_.fail("axis_x,axis_y,axis_z must not all be zero, nor huge: a direction is about 1 long");
        result.pose.spindle_axis = *axis;
        if (cells[7] != "0" && cells[7] != "1")
            lines_.fail(fmt::format("pedal must be 0 or 1, not '{}'", one_line(cells[7])));
        result.pedal = cells[7] == "1";
        if (has_burr_) result.burr = to_burr(cells[columns_without_burr]);
        return result;
    }

    std::vector<std::string> split() const {
        std::vector<std::string> cells = cells_of(lines_.line());
        const std::size_t expected = columns_without_burr + (has_burr_ ? 1 : 0);
        if (cells.size() != expected)
            lines_.fail(fmt::format("has {} columns, the header has {}", cells.size(), expected));
        return cells;
    }

    double to_number(std::string_view cell) const {
        const std::optional<double> value = finite_number(cell);
        if (!value) lines_.fail(fmt::format("'{}' is not a finite number", one_line(cell)));
        return *value;
    }

    std::size_t to_burr(std::string_view cell) const {
        const auto value = parse_number<std::size_t>(cell);
        if (!value || *value >= burr_count_)
            lines_.fail(fmt::format("burr '{}' is not an index into the scene's set, 0 to {}", one_line(cell),
                                    burr_count_ - 1));
        return *value;
    }

    TableLines lines_;
    std::string name_;
    std::size_t burr_count_;
    bool has_burr_ = false;
};

}  // namespace

std::vector<Waypoint> read_trajectory_csv(const std::string& text, const std::string& name,
                                          std::size_t burr_count) {
    return CsvReader(text, name, burr_count).read();
}

std::vector<Waypoint> read_trajectory_csv(const std::filesystem::path& file, std::size_t burr_count) {
    return read_trajectory_csv(read_text(file, trajectory_kind), file.string(), burr_count);
}

}  // namespace osteomill
