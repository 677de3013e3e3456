// The scene of a session with its bone in it: what a session is made of, before there is a device.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/files/distinct_files.h"
#include "common/scene/scene_change.h"
#include "imaging/case/bone_source.h"

namespace osteomill {

/// What of a scene is chosen; nothing: the tooth.
struct SceneChoice {
    std::optional<std::string> name{};            ///< a phantom's or a TOML file's; absent: the bone's own
    SceneChanges changes{};                       ///< of the scene's keys
    std::optional<double> spindle_rpm{};          ///< of every burr, in place of the scene's
    std::optional<std::filesystem::path> bone{};  ///< in place of the scene's
    std::optional<std::filesystem::path> trajectory{};   ///< likewise
    std::optional<std::filesystem::path> case_folder{};  ///< of a case that is not built in
};

/// Of a case: a folder, or the name of one that is built in. Throws std::invalid_argument as scene_of_case
/// does.
SceneChoice case_chosen(const std::string& name);

struct SessionScene {
    Scene scene;
    Bone bone;
    BoneSource source{};
    std::vector<Structure> structures{};  ///< of the scene's protected tissues, in their order
    std::vector<NamedFile> files_read{};  ///< that it is made of: no output may take their place
};

/// Loads what is chosen; a bone that comes without a scene gets one, with the tool above it. What is doubtful
/// is logged. Throws in one line as the readers of scenes, cases and images do.
SessionScene load_session_scene(const SceneChoice& choice);

}  // namespace osteomill
