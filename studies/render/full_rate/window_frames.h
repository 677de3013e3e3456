// Frames of a session as render_client's window draws them: bone, tool and panels, every pixel at full
// quality.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

#include "studies/render/picture_trial.h"

namespace osteomill::study {

struct WindowFrames {
    FrameMilliseconds orbit{};
    FrameMilliseconds orbit_side_by_side{};  ///< for two eyes, half of the pixels each
    FrameMilliseconds orbit_both_whole{};    ///< for two eyes, all pixels each, as with a buffer for each
    FrameMilliseconds carve{};               ///< and applies the cut
};

/// Draws `frames` of each motion of a phantom. Writes `picture`, a PNG of the last frame before the first
/// cut. Needs a current OpenGL context. Throws std::runtime_error if the bone cannot be drawn.
WindowFrames draw_window(const std::string& phantom, const glm::ivec2& size_px, int frames,
                         const std::filesystem::path& picture);

}  // namespace osteomill::study
