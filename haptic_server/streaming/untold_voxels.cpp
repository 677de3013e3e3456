#include "haptic_server/streaming/untold_voxels.h"

namespace osteomill {

void UntoldVoxels::add(BrickIndex brick, const VoxelMask& voxels) {
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

void UntoldVoxels::add_whole(BrickIndex brick) {
    std::unique_ptr<VoxelMask>& mask = waiting_[brick];
    if (mask) --masks_;
    mask.reset();
}

BrickChange UntoldVoxels::next() const {
    const auto& [brick, mask] = *turn();
    return {brick, mask ? *mask : VoxelMask().set()};
}

void UntoldVoxels::told() {
    const auto now = turn();
    turn_ = now->first + 1;  // past the last brick of all it is the first again
    if (now->second) --masks_;
    waiting_.erase(now);
}

std::map<BrickIndex, std::unique_ptr<VoxelMask>>::const_iterator UntoldVoxels::turn() const {
    const auto found = waiting_.lower_bound(turn_);
    return found != waiting_.end() ? found : waiting_.begin();
}

}  // namespace osteomill
