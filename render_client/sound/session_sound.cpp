#include "render_client/sound/session_sound.h"

#include <utility>

#include "common/log/log.h"
#include "common/words/translation.h"

namespace osteomill {

std::string SessionSound::switch_to(bool on) {
    is_on_ = false;
    if (!on) return tr("sound off");
    try {
        if (!speaker_) speaker_ = std::make_unique<Speaker>();
        is_on_ = true;
        has_no_speaker_ = false;
        heard_time_s_ = -1.0;
        return trf("sound on: {}", speaker_->device_name());
    } catch (const NoSound& error) {
        const std::string line = trf("no sound: {}", error.what());
        log_warning("{}", line);
        return line;
    }
}

void SessionSound::open_for_warnings() {
    try {
        speaker_ = std::make_unique<Speaker>();
    } catch (const NoSound&) {
        has_no_speaker_ = true;
    }
}

std::string SessionSound::hear(const std::optional<ToolState>& tool, const SessionInfo* session,
                               std::span<const StructureDistance> distances, bool warns) {
    const StructureWarning warning =
        warns && session != nullptr ? gravest_warning(distances, session->tissues) : StructureWarning::none;
    if (!speaker_ && !has_no_speaker_ && warning != StructureWarning::none) open_for_warnings();
    if (!speaker_) return {};
    if (speaker_->has_lost_device()) {
        speaker_.reset();
        has_no_speaker_ = true;
        if (!std::exchange(is_on_, false)) return {};
        const std::string line = tr("no sound: the loudspeaker is gone");
        log_warning("{}", line);
        return line;
    }
    const bool is_news = tool && tool->time_s != heard_time_s_;
    const Burr* burr = is_news && session ? session->burr_of(tool->burr) : nullptr;
    if (burr == nullptr) return {};
    heard_time_s_ = tool->time_s;
    speaker_->hear(is_on_ ? cue_of(*tool, *burr) : SoundCue{}, warning);
    return {};
}

}  // namespace osteomill
