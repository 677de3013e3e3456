// Trajectories from CSV files, patient LPS:
//
//     t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal[,burr]
//     0.0,25.0,25.0,12.0,0,0,1,0
//
// The first line must be this header, with or without `burr` (index into the scene's set). Times ascend. The
// axis points from the tip to the shank and is normalised here. `pedal` is 0 or 1. Blank lines and lines that
// begin with # are skipped (one may name an arm: written_pose.h). Anything else is refused with file
// and line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "devices/simulated/trajectory.h"

namespace osteomill {

/// Throws std::runtime_error with one line: file, line, what is wrong, what would be right.
std::vector<Waypoint> read_trajectory_csv(const std::filesystem::path& file, std::size_t burr_count);
/// The trajectory in a text; `name` stands for the file in errors.
std::vector<Waypoint> read_trajectory_csv(const std::string& text, const std::string& name,
                                          std::size_t burr_count);

}  // namespace osteomill
