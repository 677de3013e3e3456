// A scene for a bone that comes without one: its start pose and its trajectory.
#pragma once

#include <filesystem>

#include "common/bone/bone.h"
#include "common/scene/scene.h"

namespace osteomill {

/// The scene of `--bone FILE` without `--scene`: the usual burrs at 40 000 rpm, no tissues; place_on_bone
/// places the burr once the bone is there.
Scene scene_of_bone_file(const std::filesystem::path& file);

/// Puts the start pose 3 mm outside the bone, the spindle along the shortest way out from the middle of the
/// planned region, or, without a plan, of the largest piece of bone (of 26 directions; of equals, upwards).
/// Puts the trajectory, the cavity of the tooth phantom's scene, into the bone there. Does nothing if no bone
/// is left.
void place_on_bone(Scene& scene, const Bone& bone);

}  // namespace osteomill
