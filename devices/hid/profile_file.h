// Arm profiles as TOML, strictly read: a missing, misspelt or impossible key is an error with file and line.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/hid/arm_profile.h"

namespace osteomill {

/// Reads a profile; `name` stands for the file in errors. Throws SceneError (common/scene/scene_file.h) with
/// one line: file, line, key, what would be right.
ArmProfile parse_arm_profile(std::string_view toml, const std::string& name);

/// The texts of devices/profiles/*.toml, compiled in so that their names work wherever the program lies.
struct ShippedProfile {
    std::string_view name;
    std::string_view toml;
};

std::span<const ShippedProfile> shipped_profiles();

/// The profiles that are built in, from devices/*.toml.
std::vector<std::string> shipped_profile_names();

/// The text of one; as load_arm_profile finds it.
std::string arm_profile_text(const std::string& name_or_file);

/// A shipped profile by its name, or a file by its path (which ends in .toml). Throws SceneError, or
/// std::runtime_error if there is neither, naming the shipped ones.
ArmProfile load_arm_profile(const std::string& name_or_file);

}  // namespace osteomill
