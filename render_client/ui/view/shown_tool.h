// Tool of a session as it is shown: where it is, whether its burr turns, and how far it has turned.
#pragma once

#include <optional>

#include "common/session/operator_command.h"
#include "common/session/tool_state.h"
#include "render_client/dataset/known_shanks.h"
#include "render_client/link/session_source.h"
#include "render_client/volume/passes/stereo_picture.h"

namespace osteomill {

class ShownTool {
  public:
    /// A newer state has come.
    void take(const ToolState& state);
    /// So much time has gone by since the last frame. `session` may be null.
    void turn(double elapsed_s, const SessionInfo* session);
    /// Shows the tool there instead of where the session has it; nothing: no longer.
    void show_at(const std::optional<ToolPose>& pose) { shown_pose_ = pose; }

    /// The session's tool; nothing before the first state.
    const std::optional<ToolState>& state() const { return state_; }
    /// The tool as it is shown.
    std::optional<ToolState> shown() const;
    /// Whether the burr turns in the picture: only while the source sends states.
    bool has_turning_burr() const;
    /// The tool to draw for `shown`, with the hand's target if that is away from the burr. `session` may be
    /// null.
    DrawnTool drawn(const ToolState& shown, const SessionInfo* session,
                    const std::optional<OperatorCommand>& command) const;

  private:
    std::optional<ToolState> state_;
    double age_s_ = 0.0;   ///< since it came, as far as frames were drawn since
    bool is_new_ = false;  ///< it came in the frame that is being drawn
    std::optional<ToolPose> shown_pose_;
    double spin_rad_ = 0.0;
    KnownShanks shanks_;
};

}  // namespace osteomill
