// Pictures to look at: both renderers, both shadings, before and after a carve; and the transfer functions.
#pragma once

#include <filesystem>

#include "studies/render/trial_bone.h"

namespace osteomill::study {

/// Writes BONE_RENDERER_SHADING_before.png, ..._after.png and BONE_transfer_NAME.png of the close-up into
/// `folder`, which is there. What is carved is taken over by the textures brick by brick, as in a session.
/// Throws std::runtime_error naming a file that cannot be written.
void write_gallery(const TrialBone& trial, const glm::ivec2& size_px, const std::filesystem::path& folder);

}  // namespace osteomill::study
