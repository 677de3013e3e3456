#include "render_client/link/verified_replica.h"

#include <utility>

namespace osteomill {

void VerifiedReplica::begin(SessionInfo session) {
    session_ = std::move(session);
    repair_.reset();
}

std::optional<BoneReplica> VerifiedReplica::take(BoneArrived arrived) {
    std::optional<BoneReplica> before = std::move(replica_);
    replica_.emplace(std::move(arrived.bone), std::move(arrived.checksum));
    return before;
}

VerifiedReplica::Outcome VerifiedReplica::take(const StateArrived& arrived) {
    auto followed = osteomill::follow(arrived, *replica_);
    if (auto* error = std::get_if<WireError>(&followed)) {
        ++counters_.rejected_frames;
        repair_.reset();
        return std::move(*error);
    }
    ++counters_.frames;
    Outcome outcome = check(arrived, std::get<FollowedState>(followed));
    if (std::holds_alternative<WireError>(outcome)) repair_.reset();
    return outcome;
}

VerifiedReplica::Outcome VerifiedReplica::check(const StateArrived& arrived, const FollowedState& state) {
    if (state.check == ReplicaCheck::equal) ++counters_.verified;
    if (arrived.follows_gap) ++counters_.rejected_frames;
    if (repair_) return follow(repair_->take(arrived, state.check, *replica_));

    const bool differs = state.check == ReplicaCheck::differs || state.has_regained_bone;
    if (differs) ++counters_.mismatches;
    if (!differs && !arrived.follows_gap) return std::nullopt;
    repair_.emplace();
    return follow(repair_->begin(*replica_));
}

VerifiedReplica::Outcome VerifiedReplica::follow(BoneRepair::Progress progress) {
    if (auto* error = std::get_if<WireError>(&progress)) return std::move(*error);
    if (auto* goes_on = std::get_if<BoneRepair::GoesOn>(&progress)) return std::move(goes_on->ask);
    ++counters_.repairs;
    counters_.bricks_repaired += std::get<BoneRepair::Done>(progress).bricks;
    repair_.reset();
    return std::nullopt;
}

}  // namespace osteomill
