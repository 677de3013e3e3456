#include "haptic_server/replay/recorded_session.h"

#include <stdexcept>

namespace osteomill {

SessionState RecordedSession::update(BoneReplica& mirror, std::size_t viewers) {
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
    SessionState state = playhead_.state();
    // Before the first state: where that will have it.
    if (const StateArrived* first = playhead_.next_state(); playhead_.tool() == nullptr && first != nullptr)
        state.tool = first->state.tool;
    state.events = std::exchange(events_, {});
    return state;
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
                // The playhead's own bone, which the mirror equals, has taken them.
                for (const auto& [change, fractions] : playhead_.changes())
                    if (!mirror.apply(change, fractions)) throw std::logic_error("the mirror differs");
                events_.insert(events_.end(), playhead_.state().events.begin(),
                               playhead_.state().events.end());
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
