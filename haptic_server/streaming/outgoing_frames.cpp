#include "haptic_server/streaming/outgoing_frames.h"

#include <algorithm>
#include <utility>

#include "common/wire/control_messages.h"
#include "common/wire/distance_messages.h"
#include "common/wire/frame.h"
#include "common/wire/geometry_messages.h"
#include "common/wire/scene_messages.h"
#include "common/wire/sealed_frame.h"
#include "common/wire/structure_messages.h"

namespace osteomill {

void PendingChanges::add(const BrickChange& change) {
    const auto [found, is_new] = waiting_.try_emplace(change.brick);
    Waiting& waiting = found->second;
    if (change.kind == ChangeKind::restored) waiting.kind = ChangeKind::restored;
    if (!is_new) {
        if (waiting.voxels) *waiting.voxels |= change.voxels;
    } else if (masks_ < most_masks) {
        waiting.voxels = std::make_unique<VoxelMask>(change.voxels);
        ++masks_;
    }
}

void PendingChanges::add_whole(BrickIndex brick) {
    std::unique_ptr<VoxelMask>& mask = waiting_[brick].voxels;
    if (mask) --masks_;
    mask.reset();
}

BrickChange PendingChanges::next() const {
    const auto& [brick, waiting] = *turn();
    return {brick, waiting.voxels ? *waiting.voxels : VoxelMask().set_all(), waiting.kind};
}

void PendingChanges::sent() {
    const auto now = turn();
    turn_ = now->first + 1;  // past the last brick of all it is the first again
    if (now->second.voxels) --masks_;
    waiting_.erase(now);
}

std::map<BrickIndex, PendingChanges::Waiting>::const_iterator PendingChanges::turn() const {
    const auto found = waiting_.lower_bound(turn_);
    return found != waiting_.end() ? found : waiting_.begin();
}

namespace {

/// Masks and fractions shrink to less than half while a burr cuts.
constexpr std::size_t least_shrinking = 2;

/// Margin for the rounding of a product of session time and frame rate.
constexpr double rounding_s = 1e-6;

}  // namespace

OutgoingFrames::OutgoingFrames(v2::Hello hello, const BoneReplica& mirror, FramePackers& packers,
                               std::span<const v2::StructureBricks> structures)
    : hello_(std::move(hello)), mirror_(mirror), packers_(packers), structure_pieces_(structures) {}

void OutgoingFrames::note(std::span<const BrickChange> changes) {
    for (const BrickChange& change : changes)
        if (static_cast<std::size_t>(mirror_.bone().slot(change.brick)) < next_slot_) pending_.add(change);
}

void OutgoingFrames::request_state(SessionState state, bool with_checksum) {
    events_.insert(events_.end(), state.events.begin(), state.events.end());
    while (events_.size() > most_waiting_events) events_.pop_front();
    state_ = std::move(state);
    const bool is_news = with_checksum || !pending_.empty() || !events_.empty() || !sent_ ||
                         state_.status != sent_->status || state_.distances != sent_->distances ||
                         state_.view != sent_->view || !is_within_deadband(sent_->tool, state_.tool);
    wants_state_ = wants_state_ || is_news;
    wants_checksum_ = wants_checksum_ || with_checksum;
    comparisons_left_ = std::min(comparisons_left_ + 1, most_comparisons_at_once);
}

std::optional<WireError> OutgoingFrames::compare(const v2::CompareBone& request) {
    if (stage_ == Stage::finished) return std::nullopt;
    if (stage_ != Stage::live) return WireError{"it compares a bone that it has not been sent yet"};
    if (answer_) return WireError{"it compares again before it has been answered"};
    if (comparisons_left_ == 0) return WireError{"it compares too often"};
    --comparisons_left_;
    auto compared = compare_bone(request, mirror_.bone(), mirror_.running_checksum());
    if (auto* error = std::get_if<WireError>(&compared)) return std::move(*error);
    auto& result = std::get<ComparedBone>(compared);
    for (const BrickIndex brick : result.differing_bricks) pending_.add_whole(brick);
    answer_ = std::move(result.answer);
    wants_state_ = true;
    wants_checksum_ = true;
    return std::nullopt;
}

void OutgoingFrames::finish(std::string reason, bool has_said_all) {
    if (goodbye_) return;
    goodbye_ = std::move(reason);
    if (has_said_all && has_sent_all()) return;
    wants_state_ = true;
    wants_checksum_ = true;
}

std::optional<std::string> OutgoingFrames::next(std::size_t most_state_bytes) {
    v2::ServerFrame frame;
    frame.set_sequence(sequence_ + 1);
    switch (stage_) {
        case Stage::hello:
            *frame.mutable_hello() = hello_;
            stage_ = Stage::snapshot_begin;
            break;
        case Stage::snapshot_begin:
            *frame.mutable_snapshot_begin() = snapshot_begin(mirror_.bone());
            stage_ = mirror_.bone().stored_bricks() > 0 ? Stage::snapshot_bricks : Stage::snapshot_end;
            break;
        case Stage::snapshot_bricks:
            fill_snapshot_bricks(*frame.mutable_snapshot_bricks());
            if (next_slot_ == mirror_.bone().stored_bricks()) stage_ = Stage::snapshot_end;
            break;
        case Stage::snapshot_end:
            frame.mutable_snapshot_end()->set_checksum(snapshot_checksum_);
            stage_ = Stage::live;
            break;
        case Stage::live:
            if (!structure_pieces_.empty() && !goodbye_) {
                *frame.mutable_structure_bricks() = structure_pieces_.front();
                structure_pieces_ = structure_pieces_.subspan(1);
            } else if (wants_state_) {
                fill_state(*frame.mutable_state(), most_state_bytes);
                newest_state_ = frame.sequence();
            } else if (ct_ && next_ct_voxel_ < ct_->hu.size() && !goodbye_) {
                if (!ct_packer_) ct_packer_.emplace();
                *frame.mutable_ct_piece() = ct_packer_->pack(*ct_, next_ct_voxel_);
            } else if (goodbye_) {
                frame.mutable_goodbye()->set_reason(*goodbye_);
                stage_ = Stage::finished;
            } else {
                return std::nullopt;
            }
            break;
        case Stage::finished:
            return std::nullopt;
    }
    ++sequence_;
    std::string bytes;
    append_sealed_frame(frame, bytes);
    return bytes;
}

void OutgoingFrames::fill_snapshot_bricks(v2::SnapshotBricks& message) {
    const Bone& bone = mirror_.bone();
    message = packers_.snapshot.pack(bone, next_slot_);
    for (const BrickIndex brick : message.brick())
        snapshot_checksum_ +=
            checksum_of_brick(brick, bone.fractions(static_cast<std::int32_t>(next_slot_++)));
}

void OutgoingFrames::fill_state(v2::StateFrame& state, std::size_t most_bytes) {
    *state.mutable_tool() = to_message(state_.tool);
    if (answer_) *state.mutable_comparison() = *std::exchange(answer_, std::nullopt);
    if (state_.status != SessionStatus{}) *state.mutable_status() = to_message(state_.status);
    for (const StructureDistance& distance : state_.distances) *state.add_distances() = to_message(distance);
    if (state_.view && !(sent_ && sent_->view == state_.view))
        *state.mutable_view() = to_message(*state_.view);
    add_events(state, most_bytes);
    add_changes(state, most_bytes);
    add_ticks(state);
    sent_ = state_;
    if (!pending_.empty() || !events_.empty() || !ticks_.empty())
        return;  // the rest goes into the next frame
    wants_state_ = false;
    if (std::exchange(wants_checksum_, false)) state.set_bone_checksum(mirror_.checksum());
}

void OutgoingFrames::add_events(v2::StateFrame& state, std::size_t most_bytes) {
    for (; !events_.empty() && state.ByteSizeLong() < most_bytes; events_.pop_front())
        *state.add_events() = to_message(events_.front());
}

void OutgoingFrames::add_ticks(v2::StateFrame& state) {
    if (ticks_.empty() && missed_ticks_ == 0) return;
    const auto now = std::span(ticks_).first(std::min(ticks_.size(), most_ticks_of_message));
    *state.mutable_ticks() = packers_.ticks.pack(std::exchange(missed_ticks_, 0), now);
    ticks_.erase(ticks_.begin(), ticks_.begin() + static_cast<std::ptrdiff_t>(now.size()));
}

void OutgoingFrames::add_changes(v2::StateFrame& state, std::size_t most_bytes) {
    const std::size_t most_packed = std::min(least_shrinking * most_bytes, largest_packed_changes_bytes);
    std::vector<BrickChange> milled;
    std::vector<BrickChange> restored;
    for (std::size_t bytes = 0; !pending_.empty(); pending_.sent()) {
        const BrickChange change = pending_.next();
        bytes += mask_bytes + change.voxels.count();
        if (bytes > most_packed && milled.size() + restored.size() > 0) break;
        (change.kind == ChangeKind::milled ? milled : restored).push_back(change);
    }
    if (!milled.empty()) *state.mutable_changes() = packers_.changes.pack(mirror_.bone(), milled);
    if (!restored.empty()) *state.mutable_restored() = packers_.changes.pack(mirror_.bone(), restored);
}

bool is_within_deadband(const ToolState& sent, const ToolState& now) {
    const double elapsed_s = now.time_s - sent.time_s;
    return elapsed_s >= 0.0 && elapsed_s < deadband_period_s - rounding_s && looks_the_same(sent, now);
}

}  // namespace osteomill
