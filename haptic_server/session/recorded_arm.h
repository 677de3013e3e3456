// Limits of the arm that a session was recorded with: in the recording's settings, and above the columns of a
// trajectory that was made of it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "simulation/device/haptic_device.h"

namespace osteomill {

nlohmann::ordered_json arm_settings(const DeviceLimits& arm);

/// Reads what arm_settings() wrote. Throws std::runtime_error in one line that begins with `name`.
DeviceLimits arm_of_settings(const std::string& text, const std::string& name);

/// The arm of a trajectory file (written_pose.h); nothing if the file names none, like a file written
/// by hand. Throws std::runtime_error, "FILE:1: WHY".
std::optional<DeviceLimits> arm_of_trajectory(const std::filesystem::path& file);

}  // namespace osteomill
