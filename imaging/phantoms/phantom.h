// Bones made by code: deterministic, no download. The default scenes stand on them.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "common/scene/scene.h"
#include "common/scene/scene_change.h"
#include "imaging/bone_from_hu.h"

namespace osteomill {

/// Labels of the tooth phantom's tissues; 0 is what is not bone.
enum class ToothTissue : std::uint8_t {
    cortical_bone = 1,
    trabecular_bone = 2,
    dentine = 3,
    enamel = 4,
    pulp = 5,
    nerve_canal = 6,
    carious_lesion = 7
};

/// A molar in a block of jaw, 512 x 512 x 128 voxels of 0.1 mm: +z is occlusal (crown up). Enamel, dentine,
/// pulp, cortical and trabecular bone, a nerve canal and a carious lesion that opens on the occlusal surface.
/// The roots are shorter than life, so that crown, roots and jaw fit into 12.8 mm, and the canal runs beside
/// their tips instead of below.
HuSlices make_tooth_phantom();

/// The homogeneous cube of the polishing experiment: 50 x 50 x 12 mm at 0.1 mm, relative stiffness 1, top
/// face exactly at z = 0, bone below.
HuSlices make_cube_phantom();

/// Threshold at which each phantom's HU becomes bone.
inline constexpr double phantom_threshold_hu = 150.0;

/// Names of the phantoms; the first is the default.
std::vector<std::string> phantom_names();

/// The scene that goes with a phantom: tissues, six burrs (1, 1.5, 2, 3, 4, 5 mm), start pose and trajectory.
/// The tooth's trajectory is the cavity that drills out the lesion with the 1.5 mm burr to a hole of 4.5 mm;
/// the cube's is the polishing slide with the 5 mm burr; the head's (see head_phantom.h) thins the vault at
/// its top with the 3 mm burr. Throws std::invalid_argument for an unknown name, listing the known ones, and
/// SceneError for a change that cannot be (scene_file.h).
Scene phantom_scene(const std::string& name, const SceneChanges& changes = {});

/// A phantom: CT numbers to make bone from, or, where making them would take too long, the bone itself.
/// Throws like phantom_scene.
std::variant<HuSlices, Bone> make_phantom(const std::string& name);

}  // namespace osteomill
