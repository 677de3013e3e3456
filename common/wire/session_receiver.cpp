#include "common/wire/session_receiver.h"

#include <utility>

#include "common/text/foreign_text.h"
#include "common/wire/control_messages.h"
#include "common/wire/distance_messages.h"
#include "common/wire/geometry_messages.h"
#include "common/wire/packed_changes.h"
#include "common/wire/scene_messages.h"
#include "common/wire/structure_messages.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

namespace {

/// A state, without the changes of the bone. Refuses as tool_from, control_events_from,
/// structure_distances_from and viewpoint_from do, for so many burrs and tissues.
std::variant<SessionState, WireError> session_state_from(const v2::StateFrame& message,
                                                         std::size_t burr_count, std::size_t tissue_count) {
    auto tool = tool_from(message.tool(), burr_count);
    if (auto* error = std::get_if<WireError>(&tool)) return std::move(*error);
    auto events = control_events_from(message.events());
    if (auto* error = std::get_if<WireError>(&events)) return std::move(*error);
    auto distances = structure_distances_from(message.distances(), tissue_count);
    if (auto* error = std::get_if<WireError>(&distances)) return std::move(*error);
    std::optional<Viewpoint> view;
    if (message.has_view()) {
        auto looked = viewpoint_from(message.view());
        if (auto* error = std::get_if<WireError>(&looked)) return std::move(*error);
        view = std::get<Viewpoint>(looked);
    }
    return SessionState{.tool = std::get<ToolState>(std::move(tool)),
                        .events = std::get<std::vector<ControlEvent>>(std::move(events)),
                        .status = session_status_from(message.status()),
                        .distances = std::get<std::vector<StructureDistance>>(std::move(distances)),
                        .view = view};
}

}  // namespace

std::variant<SessionEvent, WireError> SessionReceiver::take(v2::ServerFrame frame) {
    const bool follows_gap = stage_ != Stage::hello && frame.sequence() != last_sequence_ + 1;
    if (follows_gap && !(may_miss_frames() && frame.sequence() > last_sequence_))
        return WireError{"frame " + std::to_string(frame.sequence()) + " came after " +
                         std::to_string(last_sequence_)};
    last_sequence_ = frame.sequence();
    if (follows_gap) structures_.miss();

    if (stage_ == Stage::hello && frame.has_hello()) return take_hello(frame.hello());
    if (stage_ == Stage::snapshot_begin && frame.has_snapshot_begin())
        return take_snapshot_begin(frame.snapshot_begin());
    if (stage_ == Stage::snapshot && frame.has_snapshot_bricks())
        return take_snapshot_bricks(frame.snapshot_bricks());
    if (stage_ == Stage::snapshot && frame.has_snapshot_end()) return take_snapshot_end(frame.snapshot_end());
    if (stage_ == Stage::live && frame.has_state())
        return take_state(std::move(*frame.mutable_state()), follows_gap);
    if (stage_ == Stage::live && frame.has_structure_bricks()) {
        auto taken = structures_.take(frame.structure_bricks());
        if (auto* error = std::get_if<WireError>(&taken)) return std::move(*error);
        return SessionEvent(StructureArrived{std::get<0>(std::move(taken))});
    }
    if (stage_ == Stage::live && frame.has_ct_piece())
        return SessionEvent(
            CtPieceArrived{std::make_shared<const v2::CtPiece>(std::move(*frame.mutable_ct_piece()))});
    if (stage_ != Stage::hello && stage_ != Stage::over && frame.has_goodbye()) {
        stage_ = Stage::over;
        return SessionEvent(SaidGoodbye{frame.goodbye().reason()});
    }
    return WireError{"frame " + std::to_string(frame.sequence()) + " is not what should come there"};
}

bool SessionReceiver::may_miss_frames() const {
    return gaps_ == Gaps::reported && stage_ == Stage::live;
}

void SessionReceiver::go_on_behind(std::uint64_t sequence) {
    stage_ = Stage::live;
    last_sequence_ = sequence;
    structures_.miss();
}

SessionReceiver::Outcome SessionReceiver::take_hello(const v2::Hello& hello) {
    if (hello.protocol_major() != protocol_major) {
        stage_ = Stage::over;
        return SessionEvent(SpeaksOtherProtocol{hello.protocol_major(), printable(hello.program_version())});
    }
    auto info = session_info_from(hello);
    if (auto* error = std::get_if<WireError>(&info)) return *error;
    burr_count_ = std::get<SessionInfo>(info).burrs.size();
    tissues_ = std::get<SessionInfo>(info).tissues;
    stage_ = Stage::snapshot_begin;
    return SessionEvent(std::get<SessionInfo>(std::move(info)));
}

SessionReceiver::Outcome SessionReceiver::take_snapshot_begin(const v2::SnapshotBegin& message) {
    auto begun = SnapshotAssembler::begin(message);
    if (auto* error = std::get_if<WireError>(&begun)) return *error;
    assembler_.emplace(std::get<SnapshotAssembler>(std::move(begun)));
    bricks_received_ = 0;
    bricks_announced_ = message.brick_count();
    stage_ = Stage::snapshot;
    return SessionEvent(SnapshotGoesOn{});
}

SessionReceiver::Outcome SessionReceiver::take_snapshot_bricks(const v2::SnapshotBricks& message) {
    if (auto error = assembler_->add(message)) return *error;
    bricks_received_ = assembler_->bricks_received();
    return SessionEvent(SnapshotGoesOn{});
}

SessionReceiver::Outcome SessionReceiver::take_snapshot_end(const v2::SnapshotEnd& message) {
    auto finished = std::move(*assembler_).finish(message);
    assembler_.reset();
    if (auto* error = std::get_if<WireError>(&finished)) return *error;
    Bone& bone = std::get<Bone>(finished);
    RunningChecksum terms(bone);
    size_bricks_ = bone.content().size_bricks;
    structures_ = StructureAssembler(tissues_, bone.grid());
    stage_ = Stage::live;
    return SessionEvent(BoneArrived{std::move(bone), std::move(terms)});
}

SessionReceiver::Outcome SessionReceiver::take_state(v2::StateFrame message, bool follows_gap) const {
    auto state = session_state_from(message, burr_count_, tissues_.size());
    if (auto* error = std::get_if<WireError>(&state)) return std::move(*error);
    StateArrived arrived{.state = std::get<SessionState>(std::move(state)), .follows_gap = follows_gap};
    if (message.has_changes())
        if (auto error = unpack(message.changes(), ChangeKind::milled, size_bricks_, arrived.changes))
            return *std::move(error);
    if (message.has_restored())
        if (auto error = unpack(message.restored(), ChangeKind::restored, size_bricks_, arrived.changes))
            return *std::move(error);
    if (message.bone_checksum() != 0) arrived.bone_checksum = message.bone_checksum();
    if (message.has_ticks()) {
        auto ticks = unpack(message.ticks(), burr_count_);
        if (auto* error = std::get_if<WireError>(&ticks)) return std::move(*error);
        arrived.ticks = std::get<TickBlock>(std::move(ticks));
    }
    if (message.has_comparison())
        arrived.comparison = std::make_shared<const v2::Comparison>(std::move(*message.mutable_comparison()));
    return SessionEvent(std::move(arrived));
}

std::variant<FollowedState, WireError> follow(const StateArrived& arrived, BoneReplica& replica) {
    FollowedState followed;
    for (const ChangedBrick& changed : arrived.changes) {
        auto corrected = replica.correct(changed);
        if (auto* error = std::get_if<WireError>(&corrected)) return std::move(*error);
        if (changed.change.kind == ChangeKind::milled &&
            std::get<Correction>(corrected) == Correction::raises)
            followed.has_regained_bone = true;
    }
    if (arrived.bone_checksum)
        followed.check =
            *arrived.bone_checksum == replica.checksum() ? ReplicaCheck::equal : ReplicaCheck::differs;
    return followed;
}

}  // namespace osteomill
