#include "render_client/link/recording_player.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/words/translation.h"

namespace osteomill {

namespace {

constexpr int compression_level = 1;

}  // namespace

KeyFrames::KeyFrames(Playhead::Mark start) : marks_{std::move(start)}, compressor_(compression_level) {}

void KeyFrames::before_step(const Playhead& playhead) {
    const StateArrived* next = playhead.next_state();
    if (next == nullptr) return;
    const bool is_news = *playhead.next_time_s() >= marks_.back().time_s;
    for (const ChangedBrick& changed : next->changes) {
        const BrickIndex brick = changed.change.brick;
        const std::int32_t slot = playhead.bone().slot(brick);
        if (slot == BoneContent::no_slot) continue;  // the playhead will refuse it
        if (is_news) changed_.insert(brick);
        // Until now it was as it first came.
        if (!versions_.contains(brick)) keep(brick, playhead.bone().fractions(slot), 0);
    }
}

void KeyFrames::after_step(const Playhead& playhead) {
    if (playhead.time_s() < marks_.back().time_s + interval_s) return;
    marks_.push_back(playhead.mark());
    for (const BrickIndex brick : changed_)
        keep(brick, playhead.bone().fractions(playhead.bone().slot(brick)), marks_.size() - 1);
    changed_.clear();
}

void KeyFrames::wind_back(Playhead& playhead, double time_s) const {
    const auto later = std::ranges::upper_bound(marks_, time_s, {}, &Playhead::Mark::time_s);
    const auto key = static_cast<std::size_t>(std::max<std::ptrdiff_t>(later - marks_.begin(), 1) - 1);
    ByteBrick fractions;
    for (const auto& [brick, versions] : versions_) {
        const auto newer = std::ranges::upper_bound(versions, key, {}, &Version::key);
        const std::vector<std::uint8_t>& compressed = std::prev(newer)->compressed;
        const std::size_t size =
            ZSTD_decompress(fractions.data(), fractions.size(), compressed.data(), compressed.size());
        if (size != fractions.size()) throw std::logic_error("a key frame cannot be unpacked");
        playhead.set_fractions(brick, fractions);
    }
    playhead.go_back_to(marks_[key]);
}

void KeyFrames::keep(BrickIndex brick, BrickFractions fractions, std::size_t key) {
    const auto compressed = compressor_.compress(fractions);
    memory_bytes_ += compressed.size() + sizeof(Version);
    versions_[brick].push_back({key, {compressed.begin(), compressed.end()}});
}

namespace {

/// Frames taken in one poll. A frame takes some ten microseconds to apply: a poll stays below a picture's
/// time, and an hour is crossed in a second or two.
constexpr int most_frames_a_poll = 1000;

}  // namespace

RecordingPlayer::RecordingPlayer(std::filesystem::path file, double speed, double from_s)
    : file_(std::move(file)), speed_(std::clamp(speed, slowest, fastest)), outline_(outline_of(file_)) {
    open();
    if (from_s > outline_.duration_s)
        throw RecordingError(
            fmt::format("--from-s {}: the recording lasts {:.3f} s", from_s, outline_.duration_s));
    seek(from_s);
}

void RecordingPlayer::open() {
    playhead_.emplace(file_);
    keys_.emplace(playhead_->mark());
    begins_s_ = session_begins_s_ = playhead_->time_s();
    target_s_ = std::max(target_s_, begins_s_);
    is_fresh_ = true;
    is_at_end_ = false;
    frame_rate_ = {};
    byte_rate_ = {};
}

LinkUpdate RecordingPlayer::poll(Time now) {
    LinkUpdate update;
    const std::chrono::duration<double> elapsed = now - last_poll_.value_or(now);
    last_poll_ = now;
    if (is_playing_) target_s_ = std::min(target_s_ + speed_ * elapsed.count(), outline_.duration_s);
    try {
        go_towards_target(update);
    } catch (const RecordingError& error) {
        error_ = error.what();
        outline_.duration_s = target_s_ = playhead_->time_s();
    }
    update.changes = playhead_->take_changes();
    if (update.bone_replaced) update.changes.clear();
    update.controls = playhead_->state().status;
    update.distances = playhead_->state().distances;
    update.view = playhead_->state().view;
    const std::vector<Structure>& structures = playhead_->structures();
    while (shown_structures_ < structures.size())
        update.structures.push_back(structures[shown_structures_++]);
    if (std::exchange(tool_is_news_, false) && playhead_->tool() != nullptr) update.tool = *playhead_->tool();

    const bool has_ended = is_at_end_ && target_s_ >= outline_.duration_s;
    if (has_ended || !error_.empty()) is_playing_ = false;
    update.status = !error_.empty() ? LinkStatus::refused
                    : has_ended     ? LinkStatus::finished
                                    : LinkStatus::live;
    update.status_line = status_line();
    update.frames = playhead_->counts().states;
    update.checksums_verified = playhead_->counts().checksums_verified;
    update.connections = 1;
    update.frames_per_s = frame_rate_.update(playhead_->counts().states, now);
    update.bytes_per_s = byte_rate_.update(playhead_->counts().bytes, now);
    return update;
}

void RecordingPlayer::play() {
    if (!error_.empty()) return;
    if (is_at_end_ && target_s_ >= outline_.duration_s) seek(begins_s_);
    is_playing_ = true;
}

void RecordingPlayer::set_speed(double speed) {
    speed_ = std::clamp(speed, slowest, fastest);
}

void RecordingPlayer::seek(double time_s) {
    target_s_ = std::clamp(time_s, begins_s_, std::max(begins_s_, outline_.duration_s));
}

bool RecordingPlayer::has_arrived() const {
    const std::optional<double> next_s = playhead_->next_time_s();
    return !is_fresh_ && target_s_ >= playhead_->time_s() && (!next_s || *next_s > target_s_);
}

void RecordingPlayer::go_towards_target(LinkUpdate& update) {
    if (target_s_ < playhead_->time_s()) wind_back();
    // Shows the bone as it first was: textures are made for the most bone that there will be.
    if (std::exchange(is_fresh_, false)) return announce_bone(update);
    if (!error_.empty()) return;
    for (int frames = 0; frames < most_frames_a_poll; ++frames) {
        keys_->before_step(*playhead_);
        switch (playhead_->step(target_s_)) {
            case Playhead::Step::state:
                keys_->after_step(*playhead_);
                tool_is_news_ = true;
                update.events.insert(update.events.end(), playhead_->state().events.begin(),
                                     playhead_->state().events.end());
                break;
            case Playhead::Step::new_bone:
                keys_.emplace(playhead_->mark());
                session_begins_s_ = playhead_->time_s();
                // At once: a thread that makes textures of the bone before may not read another in its place.
                announce_bone(update);
                return;
            case Playhead::Step::goodbye:
                break;
            case Playhead::Step::nothing_due:
                return;
            case Playhead::Step::end:
                is_at_end_ = true;
                return;
        }
    }
}

void RecordingPlayer::announce_bone(LinkUpdate& update) {
    update.bone_replaced = true;
    shown_structures_ = 0;
}

void RecordingPlayer::wind_back() {
    is_at_end_ = false;
    error_.clear();
    if (target_s_ < session_begins_s_) return open();
    keys_->wind_back(*playhead_, target_s_);
    tool_is_news_ = playhead_->tool() != nullptr;
}

std::string RecordingPlayer::status_line() const {
    if (!error_.empty()) return tr_about_file(error_);
    const std::string name = file_.filename().string();
    return is_at_end_ && playhead_->is_truncated() ? trf("recording {}, which ends within a frame", name)
                                                   : trf("recording {}", name);
}

}  // namespace osteomill
