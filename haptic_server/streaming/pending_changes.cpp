#include "haptic_server/streaming/pending_changes.h"

namespace osteomill {

void PendingChanges::add(const BrickChange& change) {
    const auto& [brick, voxels] = change;
    const auto found = waiting_.find(brick);
    if (found != waiting_.end()) {
        if (found->second) *found->second |= voxels;
    } else if (masks_ == most_masks) {
        add_whole(brick);
    } else {
        waiting_.emplace(brick, std::make_unique<VoxelMask>(voxels));
        ++masks_;
    }
}

void PendingChanges::add_whole(BrickIndex brick) {
    std::unique_ptr<VoxelMask>& mask = waiting_[brick];
    if (mask) --masks_;
    mask.reset();
}

BrickChange PendingChanges::next() const {
    const auto& [brick, mask] = *turn();
    return {brick, mask ? *mask : VoxelMask().set_all()};
}

void PendingChanges::sent() {
    const auto now = turn();
    turn_ = now->first + 1;  // past the last brick of all it is the first again
    if (now->second) --masks_;
    waiting_.erase(now);
}

std::map<BrickIndex, std::unique_ptr<VoxelMask>>::const_iterator PendingChanges::turn() const {
    const auto found = waiting_.lower_bound(turn_);
    return found != waiting_.end() ? found : waiting_.begin();
}

}  // namespace osteomill
