#include <stdexcept>

#include "haptic_server/imaging/head_phantom.h"
#include "haptic_server/imaging/phantom.h"

namespace osteomill {

namespace {

std::uint8_t label(ToothTissue tissue) {
    return static_cast<std::uint8_t>(tissue);
}

Scene tooth_scene() {
    Scene scene;
    scene.name = "tooth";
    scene.bone = PhantomSource{"tooth"};
    // Each a good step in lightness from the next, so that no kind of colour vision takes one for another.
    scene.tissues = {{label(ToothTissue::cortical_bone), "cortical bone", {226, 216, 198}, false},
                     {label(ToothTissue::trabecular_bone), "trabecular bone", {186, 146, 104}, false},
                     {label(ToothTissue::dentine), "dentine", {232, 194, 112}, false},
                     {label(ToothTissue::enamel), "enamel", {246, 244, 236}, false},
                     {label(ToothTissue::pulp), "pulp", {184, 34, 40}, true},
                     {label(ToothTissue::nerve_canal), "nerve canal", {56, 132, 196}, true},
                     {label(ToothTissue::carious_lesion), "carious lesion", {84, 54, 34}, false}};
    // 40 000 rpm, a slow dental handpiece: at the published 10 000 rpm enamel would push back with several
    // newtons, more than the arm can render or a dentist would use (about 1 N).
    scene.burrs = default_burr_set(40'000.0 / 60.0);
    scene.start_burr = 1;
    scene.start_pose = {{0.5, 0.2, 6.5}, {0.0, 0.0, 1.0}};
    scene.trajectory = {.source = BuiltInTrajectory::cavity,
                        .start_mm = {0.5, 0.2, 3.4},
                        .travel_direction = {1.0, 0.0, 0.0},
                        .speed_mm_per_s = 4.0,
                        .depth_mm = 2.8,
                        .width_mm = 4.5};
    return scene;
}

Scene cube_scene() {
    Scene scene;
    scene.name = "cube";
    scene.bone = PhantomSource{"cube"};
    scene.burrs = default_burr_set(10'000.0 / 60.0);
    scene.start_burr = 5;
    scene.start_pose = {{-20.0, 0.0, 4.0}, {0.0, 0.0, 1.0}};
    scene.trajectory = {.source = BuiltInTrajectory::polishing,
                        .start_mm = {-20.0, 0.0, 0.0},
                        .travel_direction = {1.0, 0.0, 0.0},
                        .speed_mm_per_s = 6.0,
                        .depth_mm = 3.5,
                        .width_mm = 40.0};
    return scene;
}

Scene head_scene() {
    Scene scene;
    scene.name = "head";
    scene.bone = PhantomSource{"head"};
    scene.burrs = default_burr_set(40'000.0 / 60.0);
    scene.start_burr = 3;
    scene.start_pose = {{0.0, 0.0, 79.0}, {0.0, 0.0, 1.0}};
    // Of the vault's 2.2 mm, 0.6 mm stay.
    scene.trajectory = {.source = BuiltInTrajectory::cavity,
                        .start_mm = {0.0, 0.0, 76.0},
                        .travel_direction = {1.0, 0.0, 0.0},
                        .speed_mm_per_s = 4.0,
                        .depth_mm = 1.6,
                        .width_mm = 8.0};
    return scene;
}

[[noreturn]] void refuse(const std::string& name) {
    throw std::invalid_argument("unknown phantom '" + name + "'; choose tooth, cube or head");
}

}  // namespace

std::vector<std::string> phantom_names() {
    return {"tooth", "cube", "head"};
}

Scene phantom_scene(const std::string& name) {
    if (name == "tooth") return tooth_scene();
    if (name == "cube") return cube_scene();
    if (name == "head") return head_scene();
    refuse(name);
}

std::variant<HuSlices, Bone> make_phantom(const std::string& name) {
    if (name == "tooth") return make_tooth_phantom();
    if (name == "cube") return make_cube_phantom();
    if (name == "head") return make_braincase(head_braincase());
    refuse(name);
}

}  // namespace osteomill
