#include "render_client/link/verified_replica.h"

#include <utility>

namespace osteomill {

namespace {

/// A second one, for changes in a frame that was lost between the search and its end. More would hide a
/// defect.
constexpr int most_searches = 2;

/// One a second: a server that has not answered by then never will.
constexpr int most_mismatches = 20;

const WireError failed{"the bone differs from the server's and cannot be repaired"};

}  // namespace

BoneRepair::Progress BoneRepair::begin(const BoneReplica& replica) {
    if (++searches_ > most_searches) return failed;
    search_.emplace(replica.bone());
    has_found_all_ = false;
    return ask_next(replica);
}

BoneRepair::Progress BoneRepair::take(const StateArrived& state, ReplicaCheck check,
                                      const BoneReplica& replica) {
    // The answer may be among the missing frames.
    if (state.follows_gap) return WireError{"frames were lost while the bone was being repaired"};
    GoesOn next;
    if (state.comparison) {
        if (auto error = search_->take(*state.comparison)) return std::move(*error);
        Progress progress = ask_next(replica);
        if (std::holds_alternative<WireError>(progress)) return progress;
        next = std::get<GoesOn>(std::move(progress));
    }
    if (has_found_all_ && check == ReplicaCheck::equal) return Done{search_->bricks_found()};
    if (has_found_all_ && check == ReplicaCheck::differs) return begin(replica);
    if (check == ReplicaCheck::differs && ++mismatches_ > most_mismatches) return failed;
    return next;
}

BoneRepair::Progress BoneRepair::ask_next(const BoneReplica& replica) {
    GoesOn next{search_->next(replica.bone(), replica.running_checksum())};
    if (search_->requests() > most_requests_of_a_search)
        return WireError{"the bone differs from the server's almost everywhere"};
    has_found_all_ = !next.ask;
    return next;
}

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
