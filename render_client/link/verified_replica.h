// A client's replica of the server's bone, verified and repaired, through one session after another: follows
// the state frames, checks every checksum, and has the bricks that differ sent again if one does not hold. No
// sockets, no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "common/wire/bone_comparison.h"
#include "common/wire/frame.h"
#include "common/wire/session_info.h"
#include "common/wire/session_receiver.h"

namespace osteomill {

/// Repair of a copy of the bone that differs from the server's, without a new snapshot.
///
/// The copy is compared with the server's in ever smaller parts; bricks that differ come with the state
/// frames, which go on meanwhile. The next checksum that the server states then must hold. A copy that still
/// differs is searched once more; if that fails, too, it needs a snapshot.
class BoneRepair {
  public:
    struct GoesOn {
        std::optional<v2::CompareBone> ask{};  ///< to be sent to the server
    };
    struct Done {
        std::size_t bricks = 0;  ///< that differed
    };
    /// An error: the repair has failed.
    using Progress = std::variant<GoesOn, Done, WireError>;

    Progress begin(const BoneReplica& replica);

    /// After a state frame has been applied.
    Progress take(const StateArrived& state, ReplicaCheck check, const BoneReplica& replica);

  private:
    Progress ask_next(const BoneReplica& replica);

    std::optional<DifferenceSearch> search_;
    bool has_found_all_ = false;
    int searches_ = 0;
    int mismatches_ = 0;
};

class VerifiedReplica {
  public:
    struct Counters {
        std::uint64_t frames = 0;           ///< state frames applied
        std::uint64_t verified = 0;         ///< checksums found equal
        std::uint64_t mismatches = 0;       ///< checksums found different
        std::uint64_t rejected_frames = 0;  ///< that made no sense, or that came after a gap
        std::uint64_t repairs = 0;          ///< after which the copy was equal again
        std::uint64_t bricks_repaired = 0;  ///< that differed
    };
    /// The request to send to the server now; an error says why a fresh bone is needed.
    using Outcome = std::variant<std::optional<v2::CompareBone>, WireError>;

    /// A server has said hello. The bone stays the one before, if any, until its own has come.
    void begin(SessionInfo session);
    /// Takes over the bone of the session that began last. Returns the one it replaces, because freeing that
    /// takes long.
    std::optional<BoneReplica> take(BoneArrived arrived);
    /// An error: part of the frame may have been applied, or the repair has failed. There must be a bone of
    /// this session.
    Outcome take(const StateArrived& arrived);

    /// The changes of the bone since the last call, or since the bone came.
    std::vector<BrickChange> take_changes() {
        return replica_ ? replica_->take_changes() : std::vector<BrickChange>();
    }

    const Bone* bone() const { return replica_ ? &replica_->bone() : nullptr; }
    const SessionInfo* session() const { return session_ ? &*session_ : nullptr; }
    /// The checksum of bone(), which must be there.
    std::uint64_t checksum() const { return replica_->checksum(); }
    bool is_being_repaired() const { return repair_.has_value(); }
    const Counters& counters() const { return counters_; }

  private:
    Outcome check(const StateArrived& arrived, const FollowedState& state);
    Outcome follow(BoneRepair::Progress progress);

    std::optional<SessionInfo> session_;
    std::optional<BoneReplica> replica_;
    std::optional<BoneRepair> repair_;
    Counters counters_;
};

}  // namespace osteomill
