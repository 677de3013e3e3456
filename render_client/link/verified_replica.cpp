#include "render_client/link/verified_replica.h"

#include <utility>

namespace osteomill {

void VerifiedReplica::begin(SessionInfo session) {
    session_ = std::move(session);
    repair_.reset();
}

std::optional<BoneReplica> VerifiedReplica::take(BoneArrived arrived) {
    std::optional<BoneReplica> before = std::exchange(replica_, std::nullopt);
    replica_.emplace(std::move(arrived.bone), std::move(arrived.checksum));
    return before;
}

std::variant<VerifiedReplica::Applied, WireError> VerifiedReplica::take(const StateArrived& arrived) {
    auto outcome = osteomill::follow(arrived.frame, *session_, *replica_);
    if (auto* error = std::get_if<WireError>(&outcome)) {
        ++counters_.rejected_frames;
        repair_.reset();
        return std::move(*error);
    }
    ++counters_.frames;
    auto& state = std::get<FollowedState>(outcome);
    auto asked = check(arrived, state);
    if (auto* error = std::get_if<WireError>(&asked)) {
        repair_.reset();
        return std::move(*error);
    }
    return Applied{std::move(state.tool), std::move(state.events), state.status, std::move(state.distances),
                   std::get<0>(std::move(asked))};
}

VerifiedReplica::Asked VerifiedReplica::check(const StateArrived& arrived, const FollowedState& state) {
    if (state.check == ReplicaCheck::equal) ++counters_.verified;
    if (arrived.follows_gap) ++counters_.rejected_frames;
    if (repair_) return follow(repair_->take(arrived, state.check, *replica_));

    const bool differs = state.check == ReplicaCheck::differs || state.has_regained_bone;
    if (differs) ++counters_.mismatches;
    if (!differs && !arrived.follows_gap) return std::nullopt;
    if (session_->protocol_minor < first_minor_that_compares)
        return WireError{"the bone differs from the server's"};
    repair_.emplace();
    return follow(repair_->begin(*replica_));
}

VerifiedReplica::Asked VerifiedReplica::follow(BoneRepair::Progress progress) {
    if (auto* error = std::get_if<WireError>(&progress)) return std::move(*error);
    if (auto* goes_on = std::get_if<BoneRepair::GoesOn>(&progress)) return std::move(goes_on->ask);
    ++counters_.repairs;
    counters_.bricks_repaired += std::get<BoneRepair::Done>(progress).bricks;
    repair_.reset();
    return std::nullopt;
}

}  // namespace osteomill
