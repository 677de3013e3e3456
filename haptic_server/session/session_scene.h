// The scene of a session with its bone in it: what a session is made of, before there is a device.
#pragma once

#include <cstdint>
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

/// What a session's scene was made of, in short.
struct SceneDigests {
    std::uint64_t bone = 0;                     ///< as it was loaded, with all channels
    std::optional<std::uint64_t> scene_file{};  ///< nothing: built in
    std::optional<std::uint64_t> trajectory{};  ///< of its file, if it is from one
    std::uint64_t structures = 0;               ///< where protected structures are
};

struct SessionScene {
    Scene scene;
    Bone bone;
    BoneSource source{};
    std::vector<Structure> structures{};  ///< of the scene's protected tissues, in their order
    std::vector<NamedFile> files_read{};  ///< that it is made of: no output may take their place
    SceneDigests digests{};
};

/// Loads what is chosen; a bone that comes without a scene gets one, with the tool above it. What is doubtful
/// is logged. Throws in one line as the readers of scenes, cases and images do. `similar`: of the same case
/// with other settings, whose bone is shared where they make the same of it; null: there is none.
SessionScene load_session_scene(const SceneChoice& choice, const SessionScene* similar = nullptr);

}  // namespace osteomill
