#include <stdexcept>

#include "common/scene/scene_file.h"
#include "common/scene/shipped_scenes.h"
#include "imaging/phantoms/head_phantom.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

[[noreturn]] void refuse(const std::string& name) {
    throw std::invalid_argument("unknown phantom '" + name + "'; choose tooth, cube or head");
}

}  // namespace

std::vector<std::string> phantom_names() {
    return {"tooth", "cube", "head"};
}

Scene phantom_scene(const std::string& name, const SceneChanges& changes) {
    const auto shipped = [&](std::string_view text) {
        return parse_scene(text, "scenes/" + name + ".toml", {}, changes);
    };
    if (name == "tooth") return shipped(tooth_scene_text);
    if (name == "cube") return shipped(cube_scene_text);
    if (name == "head") return shipped(head_scene_text);
    refuse(name);
}

std::variant<HuSlices, Bone> make_phantom(const std::string& name) {
    if (name == "tooth") return make_tooth_phantom();
    if (name == "cube") return make_cube_phantom();
    if (name == "head") return make_braincase(head_braincase());
    refuse(name);
}

}  // namespace osteomill
