#include "common/wire/bone_replica.h"

#include <algorithm>
#include <utility>

namespace osteomill {

BoneReplica::BoneReplica(Bone bone) : bone_(std::move(bone)), checksum_(bone_) {}

bool BoneReplica::apply(const BrickChange& change, BrickFractions fractions) {
    if (!osteomill::apply(change, fractions, bone_)) return false;
    Changed& changed = changed_[change.brick];
    changed.voxels(change.kind) |= change.voxels;
    changed.awaits_checksum = true;
    return true;
}

std::optional<WireError> BoneReplica::apply(const v1::BrickEdit& edit) {
    if (auto error = apply_brick_edit(edit, bone_)) return error;
    mark(edit, ChangeKind::milled);
    return std::nullopt;
}

std::optional<WireError> BoneReplica::restore(const v1::BrickEdit& edit) {
    auto effect = correct_with_brick_edit(edit, bone_);
    if (auto* error = std::get_if<WireError>(&effect)) return std::move(*error);
    mark(edit, ChangeKind::restored);
    return std::nullopt;
}

std::variant<EditEffect, WireError> BoneReplica::correct(const v1::BrickEdit& edit) {
    auto effect = correct_with_brick_edit(edit, bone_);
    if (std::holds_alternative<EditEffect>(effect)) mark(edit, ChangeKind::milled);
    return effect;
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

void BoneReplica::mark(const v1::BrickEdit& edit, ChangeKind kind) {
    VoxelMask& voxels = changed_[edit.brick()].voxels(kind);
    for (int i = 0; i + 1 < edit.changed_size(); i += 2)
        for (std::size_t k = 0; k < edit.changed(i + 1); ++k) voxels.set(edit.changed(i) + k);
    checksum_.update(bone_, bone_.slot(edit.brick()));
}

}  // namespace osteomill
