// Requests that a person made with buttons on the panels, for the window to pass on once a frame is drawn.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/session/session_control.h"
#include "render_client/ui/input/key_bindings.h"

namespace osteomill {

struct SessionRequests {
    std::vector<Action> actions;           ///< as keys would request them
    std::vector<SessionControl> controls;  ///< for the server
    std::optional<std::size_t> burr;
    bool switches_pedal = false;
    bool ends_program = false;
};

}  // namespace osteomill
