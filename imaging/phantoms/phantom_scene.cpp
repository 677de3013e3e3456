#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "common/scene/scene.h"
#include "common/scene/scene_file.h"
#include "common/scene/shipped_scenes.h"
#include "imaging/phantoms/head_phantom.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

[[noreturn]] void refuse(const std::string& name) {
    throw std::invalid_argument(
        fmt::format("unknown phantom '{}'; choose one of {}", name, fmt::join(phantom_names, ", ")));
}

}  // namespace

Scene phantom_scene(const std::string& name, const SceneChanges& changes) {
    const auto shipped = std::ranges::find(shipped_scenes, name, &ShippedScene::name);
    if (shipped == shipped_scenes.end()) refuse(name);
    return parse_scene(shipped->text, "scenes/" + name + ".toml", {}, changes);
}

std::variant<HuSlices, Bone> make_phantom(const std::string& name) {
    if (name == "jaw") return make_jaw_phantom();
    if (name == "mastoid") return make_mastoid_phantom();
    if (name == "tooth") return make_tooth_phantom();
    if (name == "cube") return make_cube_phantom();
    if (name == "head") return make_braincase(head_braincase());
    refuse(name);
}

}  // namespace osteomill
