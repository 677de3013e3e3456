#include "haptic_server/streaming/pending_changes.h"

namespace osteomill {

void PendingChanges::add(const BrickChange& change) {
    const auto [found, is_new] = waiting_.try_emplace(change.brick);
    Waiting& waiting = found->second;
    if (change.kind == ChangeKind::restored) waiting.kind = ChangeKind::restored;
    if (!is_new) {
        if (waiting.voxels) *waiting.voxels |= change.voxels;
    } else if (masks_ < most_masks) {
        waiting.voxels = std::make_unique<VoxelMask>(change.voxels);
        ++masks_;
    }
}

void PendingChanges::add_whole(BrickIndex brick) {
    std::unique_ptr<VoxelMask>& mask = waiting_[brick].voxels;
    if (mask) --masks_;
    mask.reset();
}

BrickChange PendingChanges::next() const {
    const auto& [brick, waiting] = *turn();
    return {brick, waiting.voxels ? *waiting.voxels : VoxelMask().set_all(), waiting.kind};
}

void PendingChanges::sent() {
    const auto now = turn();
    turn_ = now->first + 1;  // past the last brick of all it is the first again
    if (now->second.voxels) --masks_;
    waiting_.erase(now);
}

std::map<BrickIndex, PendingChanges::Waiting>::const_iterator PendingChanges::turn() const {
    const auto found = waiting_.lower_bound(turn_);
    return found != waiting_.end() ? found : waiting_.begin();
}

}  // namespace osteomill
