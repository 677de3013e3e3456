// The sound of the session that a client shows: off until it is requested. Without a loudspeaker it says so
// in one line, and everything else goes on.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/scene/tool_state.h"
#include "common/wire/session_info.h"
#include "render_client/sound/speaker.h"

namespace osteomill {

class SessionSound {
  public:
    /// Returns one line on what came of it, for people. It is also logged where it went wrong.
    std::string switch_to(bool on);
    bool is_on() const { return speaker_ != nullptr; }

    /// The newest state of the tool, as often as there is one. Returns a line once the loudspeaker is lost,
    /// and is then off; mostly nothing.
    /// `warns`: of protected structures at these distances.
    std::string hear(const std::optional<ToolState>& tool, const SessionInfo* session,
                     std::span<const StructureDistance> distances, bool warns);

  private:
    std::unique_ptr<Speaker> speaker_;
    double heard_time_s_ = -1.0;  // session time of the state that was passed on last
};

}  // namespace osteomill
