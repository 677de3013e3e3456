// A client's copy of the server's bone through one session after another: follows the state frames, verifies
// every checksum, and has the bricks that differ told again where one does not hold. No sockets, no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "common/wire/bone_follower.h"
#include "common/wire/session_info.h"
#include "common/wire/session_receiver.h"
#include "common/wire/wire_error.h"
#include "render_client/link/bone_repair.h"

namespace osteomill {

class BoneCopy {
  public:
    struct Counters {
        std::uint64_t frames = 0;           ///< state frames applied
        std::uint64_t verified = 0;         ///< checksums found equal
        std::uint64_t mismatches = 0;       ///< checksums found different
        std::uint64_t rejected_frames = 0;  ///< that made no sense, or that came after a gap
        std::uint64_t repairs = 0;          ///< after which the copy was equal again
        std::uint64_t bricks_repaired = 0;  ///< that differed
    };
    struct Applied {
        ToolView tool;
        std::optional<v1::CompareBone> ask{};  ///< to be sent to the server
    };

    /// A server has said hello. The bone stays the one before, if any, until its own has come.
    void begin(SessionInfo session);
    /// Of the session that began last.
    void take(BoneArrived arrived);
    /// Appends the bricks that it changes to `dirty`. An error says why a fresh bone is needed: part of the
    /// frame may have been applied, or the repair has failed. There must be a bone of this session.
    std::variant<Applied, WireError> take(const StateArrived& arrived, std::vector<BrickIndex>& dirty);

    const Bone* bone() const { return follower_ ? &follower_->bone() : nullptr; }
    const SessionInfo* session() const { return session_ ? &*session_ : nullptr; }
    /// Of bone(), which must be there.
    std::uint64_t checksum() const { return follower_->checksum(); }
    bool is_being_repaired() const { return repair_.has_value(); }
    const Counters& counters() const { return counters_; }

  private:
    using Asked = std::variant<std::optional<v1::CompareBone>, WireError>;
    Asked check(const StateArrived& arrived, const BoneFollower::Applied& applied);
    Asked follow(BoneRepair::Progress progress);

    std::optional<SessionInfo> session_;
    std::optional<BoneFollower> follower_;
    std::optional<BoneRepair> repair_;
    Counters counters_;
};

}  // namespace osteomill
