#include "render_client/sound/session_sound.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace osteomill {

std::string SessionSound::switch_to(bool on) {
    if (!on) {
        speaker_.reset();
        return "sound off";
    }
    if (speaker_) return "sound on";
    try {
        speaker_ = std::make_unique<Speaker>();
        heard_time_s_ = -1.0;
        return fmt::format("sound on: {}", speaker_->device_name());
    } catch (const NoSound& error) {
        const std::string line = fmt::format("no sound: {}", error.what());
        spdlog::warn("{}", line);
        return line;
    }
}

std::string SessionSound::hear(const std::optional<ToolState>& tool, const SessionInfo* session,
                               std::span<const StructureDistance> distances, bool warns) {
    if (!speaker_) return {};
    if (speaker_->has_lost_device()) {
        speaker_.reset();
        const std::string line = "no sound: the loudspeaker is gone";
        spdlog::warn("{}", line);
        return line;
    }
    const bool is_news = tool && tool->time_s != heard_time_s_;
    if (!is_news || session == nullptr || tool->burr >= session->burrs.size()) return {};
    heard_time_s_ = tool->time_s;
    speaker_->hear(cue_of(*tool, session->burrs[tool->burr]),
                   warns ? gravest_warning(distances, session->tissues) : StructureWarning::none);
    return {};
}

}  // namespace osteomill
