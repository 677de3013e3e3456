// A scene for a bone that comes without one: where to start, and what to drill.
#pragma once

#include <filesystem>

#include "common/bone/bone.h"
#include "common/scene/scene.h"

namespace osteomill {

/// The scene of `--bone FILE` without `--scene`: the usual burrs at 40 000 rpm, no tissues; where the burr
/// goes is said by place_on_bone once the bone is there.
Scene scene_of_bone_file(const std::filesystem::path& file);

/// Puts the start pose 3 mm outside the bone on the side where the way out from the middle of what is
/// planned, or without a plan of the largest piece of bone, is shortest (of 26 directions; upwards of
/// equals), the spindle along that way; and the trajectory, the cavity of the tooth phantom's scene, into the
/// bone there. A bone of which nothing is left stays without.
void place_on_bone(Scene& scene, const Bone& bone);

}  // namespace osteomill
