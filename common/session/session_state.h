// State of a session at one frame, without its bone, as clients receive and recordings keep it.
#pragma once

#include <optional>
#include <vector>

#include "common/session/session_control.h"
#include "common/session/structure_distance.h"
#include "common/session/tool_state.h"
#include "common/session/viewpoint.h"

namespace osteomill {

struct SessionState {
    ToolState tool{};
    std::vector<ControlEvent> events{};          ///< since the frame before: controls of the session
    SessionStatus status{};                      ///< controls that are possible now
    std::vector<StructureDistance> distances{};  ///< to protected structures that are near or were touched
    /// Viewpoint of the person who moves the tool; only in a recording, and nothing if nobody sent it.
    std::optional<Viewpoint> view{};
};

}  // namespace osteomill
