#include "imaging/phantoms/phantom.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "common/scene/scene.h"
#include "common/scene/scene_file.h"
#include "common/scene/shipped_scenes.h"
#include "imaging/phantoms/head_phantom.h"

namespace osteomill {

HuSlices make_cube_phantom() {
    // A layer of air above the bone, so that its top is a surface; voxel centres at z = ..., -0.05 (bone),
    // 0.05 (air).
    const Grid grid{.size_voxels = {500, 500, 121}, .spacing_mm = 0.1, .origin_mm = {-24.95, -24.95, -11.95}};
    constexpr std::size_t bone_voxels = 500 * 500 * 120;
    return {.grid = grid,
            .labelled = false,
            .read = [=, at = std::size_t{0}](std::span<std::int16_t> hu, std::span<std::uint8_t>) mutable {
                const std::size_t bone = std::min(hu.size(), bone_voxels - std::min(at, bone_voxels));
                std::fill_n(hu.begin(), bone, static_cast<std::int16_t>(reference_bone_hu));
                std::fill(hu.begin() + static_cast<std::ptrdiff_t>(bone), hu.end(), air_hu);
                at += hu.size();
            }};
}

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
