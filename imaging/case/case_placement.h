// Position of the tool that was chosen last in a case (the window's Place): placement.toml in its folder. The
// next session of the case begins there, instead of at the scene's start pose.
#pragma once

#include <filesystem>
#include <optional>

#include "common/scene/scene.h"

namespace osteomill {

/// Nothing if the case has none. Throws SceneError, with file and line, for one that cannot be read.
std::optional<ToolPose> placement_of_case(const std::filesystem::path& folder);

/// Throws std::runtime_error in one line if it cannot be written.
void remember_placement(const std::filesystem::path& folder, const ToolPose& pose);

}  // namespace osteomill
