// The sound of the session that a client shows: the burr, if requested, and the tone that warns of protected
// structures. Without a loudspeaker everything else goes on.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/session/tool_state.h"
#include "common/wire/session_info.h"
#include "render_client/sound/speaker.h"

namespace osteomill {

class SessionSound {
  public:
    /// The burr. Returns one line about the outcome, for people. It is also logged if it went wrong.
    std::string switch_to(bool on);
    bool is_on() const { return is_on_; }

    /// The newest state of the tool, as often as there is one. Returns a line once the loudspeaker is lost,
    /// and is then off; mostly nothing.
    /// `warns`: whether to warn of protected structures at these distances, also if the burr is not heard.
    /// The loudspeaker is then opened at the first warning; without a loudspeaker there is no message, since
    /// the banner warns.
    std::string hear(const std::optional<ToolState>& tool, const SessionInfo* session,
                     std::span<const StructureDistance> distances, bool warns);

  private:
    void open_for_warnings();

    std::unique_ptr<Speaker> speaker_;
    bool is_on_ = false;
    bool has_no_speaker_ = false;  // for warnings; F9 tries again
    double heard_time_s_ = -1.0;   // session time of the state that was passed on last
};

}  // namespace osteomill
