#include "render_client/link/bone_repair.h"

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

}  // namespace osteomill
