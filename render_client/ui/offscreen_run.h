// A run without a display: draws frames at up to 30 a second while the session lives, writes some as PNG.
#pragma once

#include <functional>

#include "render_client/link/session_source.h"
#include "render_client/ui/options.h"
#include "render_client/ui/run_json.h"

namespace osteomill {

/// Time that a run without a display waits for its first bone. A window waits without limit, since it shows a
/// person the reason.
inline constexpr double longest_wait_for_bone_s = 60.0;
/// The size of a picture without a window.
inline constexpr glm::ivec2 default_offscreen_size_px(960, 600);

/// Frames are counted from the first that shows bone. Ends after options.frames of them, when the session is
/// finished and its last state drawn, or when `stop_requested` says so; final.png is then written. Throws
/// std::runtime_error if no bone comes, the server is refused or a picture cannot be written, and
/// gl::NoOpenGl.
RenderReport run_offscreen(const RenderOptions& options, SessionSource& source,
                           const std::function<bool()>& stop_requested);

}  // namespace osteomill
