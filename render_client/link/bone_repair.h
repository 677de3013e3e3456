// Repair of a copy of the bone that differs from the server's, without a new snapshot.
//
// The copy is compared with the server's in ever smaller parts; bricks that differ come with the state
// frames, which go on meanwhile. The next checksum that the server states then must hold. A copy that still
// differs is searched once more; if that fails, too, it needs a snapshot.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "common/wire/bone_comparison.h"
#include "common/wire/frame.h"
#include "common/wire/session_receiver.h"

namespace osteomill {

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

}  // namespace osteomill
