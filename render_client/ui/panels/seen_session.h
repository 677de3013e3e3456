// The session as the panels show it, and what a person asks of it with their buttons.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/session/session_control.h"
#include "render_client/link/session_source.h"
#include "render_client/ui/input/key_bindings.h"
#include "render_client/ui/view/session_sight.h"

namespace osteomill {

/// The session as the panels show it.
struct SeenSession {
    LinkUpdate link{};
    const SessionInfo* info = nullptr;                  ///< null until a server has said hello
    std::optional<ToolState> tool{};                    ///< nothing if it is not known how the tool is now
    std::optional<OperatorCommand> operator_command{};  ///< nothing if this client may not drill now
    SessionSight sight = SessionSight::now;
    bool is_recording = false;

    /// Null if there is no tool, or the server has announced no such burr.
    const Burr* burr_in_tool() const { return info && tool ? info->burr_of(tool->burr) : nullptr; }
    double burr_radius_mm() const { return burr_in_tool() != nullptr ? burr_in_tool()->radius_mm() : 0.0; }
    /// Whether the session can be controlled, by this client or another.
    bool takes_controls() const {
        return !is_recording && info != nullptr && info->accepts_controls && elements_of(sight).controls;
    }
};

/// Requests that a person made with buttons on the panels, for the window to pass on once a frame is drawn.
struct SessionRequests {
    std::vector<Action> actions;           ///< as keys would request them
    std::vector<SessionControl> controls;  ///< for the server
    std::optional<std::size_t> burr;
    bool switches_pedal = false;
    bool ends_program = false;
};

}  // namespace osteomill
