#include "common/recording/playhead.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace osteomill {

namespace {

double seconds_between(Stamp first, Stamp then) {
    return std::chrono::duration<double>(then - first).count();
}

}  // namespace

Playhead::Playhead(std::filesystem::path file) : reader_(file) {
    read_ahead();
    while (!follower_)
        if (step(std::numeric_limits<double>::infinity()) == Step::end)
            throw RecordingError(file.string() + ": ends before the bone is complete");
}

Playhead::Step Playhead::step(double until_s) {
    // A snapshot is taken whole: half a bone is nothing to show.
    for (bool is_inside_snapshot = false; next_; is_inside_snapshot = true) {
        if (!is_inside_snapshot && *next_time_s() > until_s) return Step::nothing_due;
        time_s_ = *next_time_s();
        ++frames_;
        bytes_ += next_->bytes;
        RecordedEvent event = *std::exchange(next_, std::nullopt);
        const Step step = take(std::move(event));
        read_ahead();
        if (step != Step::nothing_due) return step;
    }
    return Step::end;
}

std::optional<double> Playhead::next_time_s() const {
    if (!next_) return std::nullopt;
    return std::max(time_s_, seconds_between(*first_, next_->stamp));
}

const v1::StateFrame* Playhead::next_frame() const {
    if (!next_) return nullptr;
    const auto* state = std::get_if<StateArrived>(&next_->event);
    return state != nullptr ? &state->frame : nullptr;
}

bool Playhead::next_begins_session() const {
    return next_ && std::holds_alternative<SessionInfo>(next_->event);
}

void Playhead::go_back_to(const Mark& mark) {
    reader_.go_back_to(mark.place);
    time_s_ = mark.time_s;
    tool_ = mark.tool;
    read_ahead();
}

void Playhead::read_ahead() {
    before_next_ = reader_.mark();
    next_ = reader_.next();
    if (next_ && !first_) first_ = next_->stamp;
}

Playhead::Step Playhead::take(RecordedEvent event) {
    if (auto* info = std::get_if<SessionInfo>(&event.event)) {
        announced_ = std::move(*info);
    } else if (auto* arrived = std::get_if<BoneArrived>(&event.event)) {
        session_ = announced_;
        follower_.emplace(std::move(*arrived), session_.burrs.size());
        tool_.reset();
        return Step::new_bone;
    } else if (auto* state = std::get_if<StateArrived>(&event.event)) {
        dirty_.clear();
        auto outcome = follower_->apply(state->frame, dirty_);
        if (const auto* error = std::get_if<WireError>(&outcome))
            throw reader_.error_at(event.place, error->line);
        if (std::holds_alternative<BoneDiffers>(outcome))
            throw reader_.error_at(event.place, "the bone differs from the one recorded");
        auto& applied = std::get<BoneFollower::Applied>(outcome);
        ++states_;
        if (applied.is_verified) ++checksums_verified_;
        tool_ = std::move(applied.tool);
        frame_ = std::move(state->frame);
        return Step::state;
    } else if (std::holds_alternative<SaidGoodbye>(event.event)) {
        return Step::goodbye;
    }
    return Step::nothing_due;
}

double recording_duration_s(const std::filesystem::path& file) {
    PacketReader packets(file);
    std::optional<Stamp> first;
    Stamp last;
    while (const auto packet = packets.next()) {
        if (!first) first = last = packet->stamp;
        last = std::max(last, packet->stamp);
    }
    return first ? seconds_between(*first, last) : 0.0;
}

}  // namespace osteomill
