// What the start page shows of an imported case: a sentence, and a picture of its bone.
#pragma once

#include <filesystem>
#include <string>

#include "common/bone/bone.h"
#include "common/scene/scene.h"

namespace osteomill {

/// How large the bone is, how fine its voxels, and the tissue to be removed where there is one.
std::string sentence_about(const Scene& scene, const Bone& bone);

/// All of the bone, 240 x 160 pixels: from the front and above, as a session's first view is, turned towards
/// the side that the scene starts on. Throws std::runtime_error where it cannot be written.
void write_card_picture(const Scene& scene, const Bone& bone, const std::filesystem::path& png);

}  // namespace osteomill
