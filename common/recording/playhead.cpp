#include "common/recording/playhead.h"

#include <limits>
#include <system_error>
#include <utility>

#include "common/wire/sealed_frame.h"

namespace osteomill {

Playhead::Playhead(std::filesystem::path file) : reader_(file) {
    std::error_code unknown;  // a pipe has no size
    if (const auto bytes = std::filesystem::file_size(file, unknown); !unknown && bytes > 0)
        file_bytes_ = bytes;
    read_ahead();
    while (!replica_)
        if (step(std::numeric_limits<double>::infinity()) == Step::end)
            throw RecordingError(file.string() + ": " + "ends before the bone is complete");
}

Playhead::Step Playhead::step(double until_s) {
    // A snapshot is taken whole: half a bone is nothing to show.
    for (bool is_inside_snapshot = false; next_;) {
        if (!is_inside_snapshot && *next_time_s() > until_s) return Step::nothing_due;
        time_s_ = *next_time_s();
        ++counts_.frames;
        counts_.bytes += next_->bytes;
        RecordedEvent event = *std::exchange(next_, std::nullopt);
        is_inside_snapshot = std::holds_alternative<SessionInfo>(event.event) ||
                             std::holds_alternative<SnapshotGoesOn>(event.event);
        const Step step = take(std::move(event));
        read_ahead();
        if (step == Step::new_bone) take_structures();
        if (step != Step::nothing_due) return step;
    }
    if (what_comes_next_is_wrong_) throw RecordingError(*what_comes_next_is_wrong_);
    return Step::end;
}

void Playhead::take_structures() {
    while (next_ && std::holds_alternative<StructureArrived>(next_->event)) {
        ++counts_.frames;
        counts_.bytes += next_->bytes;
        take(*std::exchange(next_, std::nullopt));
        read_ahead();
    }
}

std::optional<double> Playhead::next_time_s() const {
    if (!next_) return std::nullopt;
    return time_.last_s();
}

const StateArrived* Playhead::next_state() const {
    return next_ ? std::get_if<StateArrived>(&next_->event) : nullptr;
}

bool Playhead::next_begins_session() const {
    return next_ && std::holds_alternative<SessionInfo>(next_->event);
}

void Playhead::go_back_to(const Mark& mark) {
    reader_.go_back_to(mark.place);
    time_ = mark.time;
    time_s_ = mark.time_s;
    state_ = mark.state;
    has_state_ = mark.has_state;
    read_ahead();
}

void Playhead::read_ahead() {
    before_next_ = reader_.mark();
    before_next_time_ = time_;
    what_comes_next_is_wrong_.reset();
    try {
        next_ = reader_.next();
    } catch (const RecordingError& error) {
        next_.reset();
        what_comes_next_is_wrong_ = error;
    }
    if (next_) time_.next_s(next_->stamp, next_begins_session());
}

Playhead::Step Playhead::take(RecordedEvent event) {
    if (auto* info = std::get_if<SessionInfo>(&event.event)) {
        announced_ = std::move(*info);
    } else if (auto* arrived = std::get_if<BoneArrived>(&event.event)) {
        session_ = announced_;
        replica_.emplace(std::move(arrived->bone), std::move(arrived->checksum));
        state_ = {};
        has_state_ = false;
        ticks_ = {};
        structures_.clear();
        return Step::new_bone;
    } else if (auto* state = std::get_if<StateArrived>(&event.event)) {
        const auto outcome = follow(*state, *replica_);
        if (const auto* error = std::get_if<WireError>(&outcome))
            throw reader_.error_at(event.place, error->line);
        const auto& followed = std::get<FollowedState>(outcome);
        if (followed.check == ReplicaCheck::differs || followed.has_regained_bone)
            throw reader_.error_at(event.place, "the bone differs from the one recorded");
        ++counts_.states;
        counts_.state_bytes += event.bytes;
        if (followed.check == ReplicaCheck::equal) ++counts_.checksums_verified;
        // A state holds the viewpoint only if it has changed.
        if (!state->state.view) state->state.view = state_.view;
        state_ = std::move(state->state);
        has_state_ = true;
        changes_ = std::move(state->changes);
        ticks_ = std::move(state->ticks);
        counts_.ticks += ticks_.ticks.size();
        counts_.missed_ticks += ticks_.missed;
        counts_.tick_bytes += ticks_.bytes;
        return Step::state;
    } else if (auto* of_structure = std::get_if<StructureArrived>(&event.event)) {
        if (of_structure->structure) structures_.push_back(*std::move(of_structure->structure));
    } else if (std::holds_alternative<SaidGoodbye>(event.event)) {
        return Step::goodbye;
    }
    return Step::nothing_due;
}

RecordedBones bones_of(const std::filesystem::path& file, const ReportProgress& on_frame) {
    Playhead playhead(file);
    Bone at_start = playhead.bone();
    std::string error = play_to_end(playhead, on_frame, [&](Playhead::Step step) {
        if (step == Playhead::Step::new_bone) at_start = playhead.bone();
    });
    return {.at_start = std::move(at_start), .at_end = playhead.bone(), .error = std::move(error)};
}

}  // namespace osteomill
