// First lines of a trajectory in CSV, for writers and readers; see devices/simulated/csv_trajectory.h.
#pragma once

#include <string_view>

namespace osteomill {

inline constexpr std::string_view trajectory_columns = "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal";
/// Column that may follow them.
inline constexpr std::string_view trajectory_burr_column = ",burr";
/// Beginning of a comment that may stand above the columns: behind it come the limits of the arm in whose
/// hand the motion was recorded, as JSON (recorded_arm.h). An arm on rails takes them.
inline constexpr std::string_view trajectory_arm = "# arm ";

}  // namespace osteomill
