// Frames of a session as render_client's window draws them: bone, tool and panels, every pixel at full
// quality.
#pragma once

#include <filesystem>

#include "analysis/output/progress.h"
#include "studies/render/full_rate/drawing_task.h"
#include "studies/render/full_rate/finished_frames.h"

namespace osteomill::study {

struct WindowFrames {
    Camera first_view{};  ///< of the window: the tool's surroundings
    FrameMilliseconds orbit{};
    FrameMilliseconds orbit_side_by_side{};  ///< for two eyes, half of the pixels each
    FrameMilliseconds orbit_both_whole{};    ///< for two eyes, all pixels each, as with a buffer for each
    FrameMilliseconds carve{};               ///< and takes over what was cut
};

/// `task.first_view` is not looked at. Writes `picture`, a PNG of the last frame before the first cut. Needs
/// a current OpenGL context. Throws std::runtime_error where the bone cannot be drawn.
WindowFrames draw_window(const DrawingTask& task, const std::filesystem::path& picture,
                         const Progress& progress);

}  // namespace osteomill::study
