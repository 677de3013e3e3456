// A run in a window, until it is closed. Two threads: the caller's reads the window's events and sends the
// operator's commands at a steady rate (hand_input.h); the other has the OpenGL context, takes in the session
// and draws the changes (redraw.h), however long that takes.
#pragma once

#include <functional>

#include "render_client/link/session_source.h"
#include "render_client/ui/options.h"
#include "render_client/ui/run_json.h"

namespace osteomill {

/// Draws until the window is closed, ESC is pressed or `stop_requested` says so. Throws gl::NoOpenGl if
/// there is no display or no OpenGL 3.3.
RenderReport run_in_window(const RenderOptions& options, SessionSource& source,
                           const std::function<bool()>& stop_requested);

}  // namespace osteomill
