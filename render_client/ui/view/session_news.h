// Changes of a session since the last drawn frame.
#pragma once

#include <optional>

#include "common/session/operator_command.h"
#include "common/session/tool_state.h"
#include "render_client/link/session_source.h"

namespace osteomill {

/// A session as the last frame showed it, beside its bone.
struct DrawnSession {
    LinkUpdate link{};
    std::optional<ToolState> tool{};
    std::optional<OperatorCommand> operator_command{};
    std::optional<int> preparation_percent{};  ///< progress of a bone or an appearance; none: all is ready
};

enum class SessionNews {
    none,
    figures,  ///< only the time, the rates, the delay
    change    ///< something that moves, appears or goes
};

/// Changes in a poll, against the session as it was drawn.
SessionNews news_since(const DrawnSession& drawn, const LinkUpdate& link,
                       const std::optional<ToolState>& tool,
                       const std::optional<OperatorCommand>& operator_command,
                       const std::optional<int>& preparation_percent);

}  // namespace osteomill
