#include "haptic_server/replay/recorded_session.h"

#include <variant>

#include "common/wire/scene_messages.h"

namespace osteomill {

ToolState RecordedSession::update(BoneReplica& mirror, std::size_t viewers) {
    if (!began_ && viewers > 0) began_ = now_();
    if (began_ && !is_over_) {
        const std::chrono::duration<double> elapsed = now_() - *began_;
        try {
            show(mirror, begins_s_ + speed_ * elapsed.count());
        } catch (const RecordingError& error) {
            error_ = error.what();
            is_over_ = true;
        }
    }
    return tool();
}

ToolState RecordedSession::tool() const {
    if (playhead_.tool()) return *playhead_.tool();
    // Before the first state: where that will have it.
    const v1::StateFrame* first = playhead_.next_frame();
    if (first == nullptr) return {};
    const auto read = tool_from(first->tool(), playhead_.session().burrs.size());
    const auto* tool = std::get_if<ToolState>(&read);
    return tool != nullptr ? *tool : ToolState{};
}

void RecordedSession::show(BoneReplica& mirror, double until_s) {
    for (;;) {
        // The next session's bone is another server's to show.
        if (playhead_.next_begins_session()) {
            is_over_ = true;
            return;
        }
        switch (playhead_.step(until_s)) {
            case Playhead::Step::state:
                for (const v1::BrickEdit& edit : playhead_.frame().edits())
                    if (const auto error = mirror.apply(edit)) throw RecordingError(error->line);
                for (const v1::BrickEdit& edit : playhead_.frame().restored())
                    if (const auto error = mirror.restore(edit)) throw RecordingError(error->line);
                events_.insert(events_.end(), playhead_.events().begin(), playhead_.events().end());
                status_ = playhead_.status();
                break;
            case Playhead::Step::nothing_due:
                return;
            case Playhead::Step::goodbye:
            case Playhead::Step::new_bone:
            case Playhead::Step::end:
                is_over_ = true;
                return;
        }
    }
}

}  // namespace osteomill
