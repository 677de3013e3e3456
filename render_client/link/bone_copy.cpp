#include "render_client/link/bone_copy.h"

#include <utility>

namespace osteomill {

void BoneCopy::begin(SessionInfo session) {
    session_ = std::move(session);
    repair_.reset();
}

void BoneCopy::take(BoneArrived arrived) {
    follower_.emplace(std::move(arrived), session_->burrs.size());
}

std::variant<BoneCopy::Applied, WireError> BoneCopy::take(const StateArrived& arrived,
                                                          std::vector<BrickIndex>& dirty) {
    auto outcome = follower_->apply(arrived.frame, dirty);
    if (auto* error = std::get_if<WireError>(&outcome)) {
        ++counters_.rejected_frames;
        repair_.reset();
        return std::move(*error);
    }
    ++counters_.frames;
    auto& applied = std::get<BoneFollower::Applied>(outcome);
    auto asked = check(arrived, applied);
    if (auto* error = std::get_if<WireError>(&asked)) {
        repair_.reset();
        return std::move(*error);
    }
    return Applied{std::move(applied.tool), std::get<0>(std::move(asked))};
}

BoneCopy::Asked BoneCopy::check(const StateArrived& arrived, const BoneFollower::Applied& applied) {
    if (applied.check == CopyCheck::equal) ++counters_.verified;
    if (arrived.follows_gap) ++counters_.rejected_frames;
    if (repair_) return follow(repair_->take(arrived, applied.check, *follower_));

    const bool differs = applied.check == CopyCheck::differs || applied.has_regained_bone;
    if (differs) ++counters_.mismatches;
    if (!differs && !arrived.follows_gap) return std::nullopt;
    if (session_->protocol_minor < first_minor_that_compares)
        return WireError{"the bone differs from the server's"};
    repair_.emplace();
    return follow(repair_->begin(*follower_));
}

BoneCopy::Asked BoneCopy::follow(BoneRepair::Progress progress) {
    if (auto* error = std::get_if<WireError>(&progress)) return std::move(*error);
    if (auto* goes_on = std::get_if<BoneRepair::GoesOn>(&progress)) return std::move(goes_on->ask);
    ++counters_.repairs;
    counters_.bricks_repaired += std::get<BoneRepair::Done>(progress).bricks;
    repair_.reset();
    return std::nullopt;
}

}  // namespace osteomill
