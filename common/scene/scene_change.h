// Keys of a scene that are set from outside its file, such as by `haptic_server --set wall_friction=0.3`.
//
//     wall_friction=0.3                a key of the scene
//     device.scale=0.5                 of a table, which is made if it is not there
//     tissues.enamel.cuttable=false    of a list of tables: of the one with that name
//     start_burr=2 mm                  a value that is no TOML is a text
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace osteomill {

struct SceneChange {
    std::string key;       ///< dotted
    std::string value;     ///< as typed
    bool is_text = false;  ///< even if it reads as a number

    bool operator==(const SceneChange&) const = default;
};

/// One after the other.
struct SceneChanges {
    std::vector<SceneChange> changes{};
    std::string option{};  ///< that they come from, for messages: "--set"
};

/// "KEY=VALUE". Throws std::invalid_argument with one line for anything else.
SceneChange parse_scene_change(std::string_view text);

}  // namespace osteomill
