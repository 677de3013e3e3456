// Poses of the hand as recordings write them. The loops compute from these, so that a recording holds the
// poses that were used: a recorded motion, played again, gives the same bone and the same forces, bit for
// bit.
//
// A nanometre and a billionth of a radian are far below the step of any encoder. Every reader accepts a
// direction rounded so as one of unit length (unit_direction).
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <string_view>

#include "common/scene/scene.h"

namespace osteomill {

inline constexpr int hand_decimals_mm = 6;
inline constexpr int axis_decimals = 9;

/// The nearest number with so many decimals; a number that has no more stays as it is, and zero has no sign:
/// a change of axes and back would lose it. Real-time safe.
template <int decimals>
double with_decimals(double value) noexcept {
    constexpr double scale = decimals == hand_decimals_mm ? 1e6 : 1e9;
    static_assert(decimals == hand_decimals_mm || decimals == axis_decimals);
    return std::nearbyint(value * scale) / scale + 0.0;
}

template <int decimals>
glm::dvec3 with_decimals(const glm::dvec3& v) noexcept {
    return {with_decimals<decimals>(v.x), with_decimals<decimals>(v.y), with_decimals<decimals>(v.z)};
}

inline ToolPose as_written(const ToolPose& pose) noexcept {
    return {with_decimals<hand_decimals_mm>(pose.position_mm),
            with_decimals<axis_decimals>(pose.spindle_axis)};
}

// First lines of a trajectory in CSV, for writers and readers; see devices/simulated/trajectory.h.

inline constexpr std::string_view trajectory_columns = "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal";
/// Column that may follow them.
inline constexpr std::string_view trajectory_burr_column = ",burr";
/// Beginning of a comment that may stand above the columns: behind it come the limits of the arm in whose
/// hand the motion was recorded, as JSON (recorded_arm.h). An arm on rails takes them.
inline constexpr std::string_view trajectory_arm = "# arm ";

}  // namespace osteomill
