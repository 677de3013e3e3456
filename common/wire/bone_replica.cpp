#include "common/wire/bone_replica.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace osteomill {

RunningChecksum::RunningChecksum(const Bone& bone) : term_by_slot_(bone.stored_bricks(), 0) {
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        update(bone, static_cast<std::int32_t>(slot));
}

void RunningChecksum::update(const Bone& bone, std::int32_t slot) {
    const auto index = static_cast<std::size_t>(slot);
    const std::uint64_t term = checksum_of_brick(bone.content().brick_of_slot[index], bone.fractions(slot));
    sum_ += term - term_by_slot_[index];
    term_by_slot_[index] = term;
}

std::uint64_t RunningChecksum::sum_of(const Bone& bone, BrickIndex first, std::uint64_t count) const {
    const std::vector<BrickIndex>& bricks = bone.content().brick_of_slot;  // ascending
    const auto begin = std::lower_bound(bricks.begin(), bricks.end(), std::uint64_t{first});
    const auto end = std::lower_bound(begin, bricks.end(), first + count);
    return std::accumulate(term_by_slot_.begin() + (begin - bricks.begin()),
                           term_by_slot_.begin() + (end - bricks.begin()), std::uint64_t{0});
}

BoneReplica::BoneReplica(Bone bone) : bone_(std::move(bone)), checksum_(bone_) {}

bool BoneReplica::apply(const BrickChange& change, BrickFractions fractions) {
    if (!osteomill::apply(change, fractions, bone_)) return false;
    Changed& changed = changed_[change.brick];
    changed.voxels(change.kind) |= change.voxels;
    changed.awaits_checksum = true;
    return true;
}

std::variant<Correction, WireError> BoneReplica::correct(const ChangedBrick& changed) {
    const auto& [change, fractions] = changed;
    const Correction correction = osteomill::correct(change, fractions, bone_);
    if (correction == Correction::not_stored || correction == Correction::outside_grid)
        return WireError{"change of brick " + std::to_string(change.brick) + " refused: " +
                         (correction == Correction::not_stored ? "no bone is stored there"
                                                               : "it puts bone outside the grid")};
    changed_[change.brick].voxels(change.kind) |= change.voxels;
    checksum_.update(bone_, bone_.slot(change.brick));
    return correction;
}

void BoneReplica::set_fractions(BrickIndex brick, BrickFractions fractions) {
    const std::int32_t slot = bone_.slot(brick);
    const auto now = bone_.fractions(slot);
    VoxelMask differing;
    for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
        if (now[voxel] != fractions[voxel]) differing.set(voxel);
    if (differing.none()) return;
    std::ranges::copy(fractions, now.begin());
    changed_[brick].milled |= differing;
    checksum_.update(bone_, slot);
}

std::vector<BrickChange> BoneReplica::take_changes() {
    std::vector<BrickChange> changes;
    changes.reserve(changed_.size());
    for (const auto& [brick, changed] : changed_) {
        if (changed.awaits_checksum) checksum_.update(bone_, bone_.slot(brick));
        if (const VoxelMask milled = changed.milled.without(changed.restored); milled.any())
            changes.push_back({brick, milled});
        if (changed.restored.any()) changes.push_back({brick, changed.restored, ChangeKind::restored});
    }
    changed_.clear();
    return changes;
}

}  // namespace osteomill
