// The scene of a session with its bone in it: a session is made of it, before there is a device.
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

/// The choices about a scene; if none are made, it is the tooth.
struct SceneChoice {
    std::optional<std::string> name{};            ///< a phantom's name or a TOML file; absent: the bone's own
    SceneChanges changes{};                       ///< to the scene's keys
    std::optional<double> spindle_rpm{};          ///< for every burr, in place of the scene's
    std::optional<std::filesystem::path> bone{};  ///< in place of the scene's
    std::optional<std::filesystem::path> trajectory{};   ///< in place of the scene's
    std::optional<std::filesystem::path> case_folder{};  ///< the folder of a case that is not built in
};

/// The choice that a case makes. `name`: a folder, or the name of a case that is built in. Throws
/// std::invalid_argument as scene_of_case does.
SceneChoice case_chosen(const std::string& name);

/// Digests of the data that a session's scene was made of.
struct SceneDigests {
    std::uint64_t bone = 0;                     ///< as it was loaded, with all channels
    std::optional<std::uint64_t> scene_file{};  ///< nothing: built in
    std::optional<std::uint64_t> trajectory{};  ///< the trajectory's file, if it is from one
    std::uint64_t structures = 0;               ///< where protected structures are
};

struct SessionScene {
    Scene scene;
    Bone bone;
    BoneSource source{};
    std::vector<Structure> structures{};  ///< the scene's protected tissues, in their order
    std::vector<NamedFile> files_read{};  ///< the files that it is made of: no output may replace them
    SceneDigests digests{};
};

/// Loads the chosen scene or bone; a bone that comes without a scene gets one, with the tool above it.
/// Doubtful data are logged. Throws in one line as the readers of scenes, cases and images do. `similar`: a
/// session scene of the same case with other settings, whose bone is shared if the settings lead to the same
/// bone; null: there is none.
SessionScene load_session_scene(const SceneChoice& choice, const SessionScene* similar = nullptr);

}  // namespace osteomill
