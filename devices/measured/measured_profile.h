// Measurements of an arm (haptic_server --measure-arm), as TOML: a table [measured], beside the name of
// the arm, or within the profile of an arm over USB (devices/hid/arm_profile.h).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/scene/toml_reader.h"
#include "simulation/device/measured_arm.h"

namespace osteomill {

struct MeasuredProfile {
    std::string arm;  ///< the name of the arm that it was measured on
    MeasuredArm measured;
};

/// The table [measured], strictly read. Throws SceneError (common/scene/scene_file.h) with one line.
MeasuredArm read_measured(TomlReader reader);

/// A file of a name and a table [measured]. Throws SceneError, or std::runtime_error for a file that cannot
/// be read.
MeasuredProfile load_measured_profile(const std::filesystem::path& file);

/// The table as text, for a file.
std::string measured_table(const MeasuredArm& measured);

/// The text of such a file.
std::string measured_profile_text(const MeasuredProfile& profile);

/// The text of an arm's profile with this table in place of the one that it has, if it has one. All other
/// lines stay as they are.
std::string with_measured_table(std::string_view profile_text, const MeasuredArm& measured);

}  // namespace osteomill
