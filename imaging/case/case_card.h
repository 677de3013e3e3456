// Card of an imported case on the start page: a sentence, and a picture of its bone.
#pragma once

#include <filesystem>
#include <string>

#include "common/bone/bone.h"
#include "common/scene/scene.h"

namespace osteomill {

/// Sizes of the bone and of its voxels, and the tissue to be removed, if there is one.
std::string sentence_about(const Scene& scene, const Bone& bone);

/// All of the bone, 240 x 160 pixels: from the front and above, like a session's first view, turned towards
/// the side on which the scene starts. Throws std::runtime_error if it cannot be written.
void write_card_picture(const Scene& scene, const Bone& bone, const std::filesystem::path& png);

}  // namespace osteomill
