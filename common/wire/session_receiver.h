// The receiving side of a session, frame by frame: checks which frames may come, and interprets them. No
// sockets, no clock: the same for a connection and for a recording.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/session/session_state.h"
#include "common/wire/bone_replica.h"
#include "common/wire/frame.h"
#include "common/wire/packed_ticks.h"
#include "common/wire/session_info.h"
#include "common/wire/snapshot.h"
#include "common/wire/structure_messages.h"

// Named here, because the generated headers take long to parse.
namespace osteomill::v2 {
class Comparison;
class CtPiece;
class Hello;
class ServerFrame;
class StateFrame;
}  // namespace osteomill::v2

namespace osteomill {

/// A piece of a snapshot: there will be more.
struct SnapshotGoesOn {};

/// A complete snapshot, with the terms of its checksum, so that a viewer need not hash all of it.
struct BoneArrived {
    Bone bone;
    RunningChecksum checksum;
};

/// A state frame. Its changes are checked against the bone when they are applied.
struct StateArrived {
    SessionState state{};
    std::vector<ChangedBrick> changes{};                 ///< in the order in which they are to be applied
    std::optional<std::uint64_t> bone_checksum{};        ///< after them
    std::shared_ptr<const v2::Comparison> comparison{};  ///< the answer to a request; null: none
    TickBlock ticks{};                                   ///< since the state before; only in recordings
    bool follows_gap = false;  ///< frames before it are missing, and with them their changes of the bone
};

/// Reaction of a receiver to a gap in the sequence of frames.
enum class Gaps {
    refused,  ///< an error
    /// Between state frames, the gap is reported with the next one, and the lost changes of the bone can be
    /// requested. Elsewhere it is an error.
    reported,
};

/// The session is over.
struct SaidGoodbye {
    std::string reason;  ///< as the server wrote it
};

/// The server speaks another major version; nothing after this can be understood.
struct SpeaksOtherProtocol {
    std::uint32_t major = 0;
    std::string program_version{};  ///< version of the program that sends it
};

/// Another piece of the CT, which the receiver assembles.
struct CtPieceArrived {
    std::shared_ptr<const v2::CtPiece> piece;
};

/// A protected structure that is complete; nothing: more of it will come.
struct StructureArrived {
    std::optional<Structure> structure;
};

using SessionEvent = std::variant<SnapshotGoesOn, CtPieceArrived, StructureArrived, SessionInfo, BoneArrived,
                                  StateArrived, SaidGoodbye, SpeaksOtherProtocol>;

class SessionReceiver {
  public:
    SessionReceiver() = default;
    explicit SessionReceiver(Gaps gaps) : gaps_(gaps) {}

    /// The next frame of the session. An error says what is wrong with it; the receiver is then of no further
    /// use.
    std::variant<SessionEvent, WireError> take(v2::ServerFrame frame);

    /// Whether a bone has come: state frames may follow.
    bool is_live() const { return stage_ == Stage::live; }
    std::uint64_t last_sequence() const { return last_sequence_; }
    /// Goes on behind an earlier state frame of this session, or a later one, as in a recording that is wound
    /// to another place. The receiver must be live or the session over.
    void go_on_behind(std::uint64_t sequence);

    /// Bricks of the snapshot that is coming or came last.
    std::uint32_t bricks_received() const { return bricks_received_; }
    std::uint32_t bricks_announced() const { return bricks_announced_; }

  private:
    using Outcome = std::variant<SessionEvent, WireError>;
    enum class Stage { hello, snapshot_begin, snapshot, live, over };

    bool may_miss_frames() const;
    Outcome take_hello(const v2::Hello& hello);
    Outcome take_snapshot_begin(const v2::SnapshotBegin& message);
    Outcome take_snapshot_bricks(const v2::SnapshotBricks& message);
    Outcome take_snapshot_end(const v2::SnapshotEnd& message);
    Outcome take_state(v2::StateFrame message, bool follows_gap) const;

    Gaps gaps_ = Gaps::refused;
    Stage stage_ = Stage::hello;
    std::uint64_t last_sequence_ = 0;
    std::optional<SnapshotAssembler> assembler_;
    std::size_t burr_count_ = 0;
    std::vector<Tissue> tissues_;
    StructureAssembler structures_;
    glm::ivec3 size_bricks_{0};  // the bone's size
    std::uint32_t bricks_received_ = 0;
    std::uint32_t bricks_announced_ = 0;
};

// A state frame, applied to a replica of the bone that is kept equal to the server's.

/// The result of checking a replica against a frame's checksum.
enum class ReplicaCheck {
    none,     ///< the frame stated none
    equal,    ///< the replica has it
    differs,  ///< the replica has another
};

struct FollowedState {
    ReplicaCheck check = ReplicaCheck::none;
    /// A change raised a fraction, which milling cannot: the replica had lost bone, and has it again. Those
    /// that restore bone are no such changes.
    bool has_regained_bone = false;
};

/// After an error part of the changes may have been applied: a fresh bone is needed.
std::variant<FollowedState, WireError> follow(const StateArrived& arrived, BoneReplica& replica);

}  // namespace osteomill
