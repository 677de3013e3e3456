// A recorded session as a film.
#pragma once

#include <functional>

#include "render_client/link/session_source.h"
#include "render_client/ui/options.h"
#include "render_client/ui/run_json.h"

namespace osteomill {

/// From options.from_s to the recording's end, at options.speed recorded seconds a second, thirty pictures a
/// second, each complete however long it takes. `source` plays a recording. Throws std::runtime_error if the
/// film cannot be made, or `stop_requested` ends it, and gl::NoOpenGl.
RenderReport run_film(const RenderOptions& options, SessionSource& source,
                      const std::function<bool()>& stop_requested);

}  // namespace osteomill
