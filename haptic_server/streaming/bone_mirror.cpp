#include "haptic_server/streaming/bone_mirror.h"

#include <utility>

namespace osteomill {

BoneMirror::BoneMirror(Bone bone) : bone_(std::move(bone)), checksum_(bone_) {}

bool BoneMirror::apply(const EditRun& run) {
    if (osteomill::apply(run, bone_) != EditOutcome::applied) return false;
    VoxelMask& mask = changed_[run.brick];
    for (std::size_t i = 0; i < run.count; ++i) mask.set(run.first_voxel + i);
    return true;
}

std::optional<WireError> BoneMirror::apply(const v1::BrickEdit& edit) {
    if (auto error = apply_brick_edit(edit, bone_)) return error;
    VoxelMask& mask = changed_[edit.brick()];
    for (int i = 0; i + 1 < edit.changed_size(); i += 2)
        for (std::size_t k = 0; k < edit.changed(i + 1); ++k) mask.set(edit.changed(i) + k);
    return std::nullopt;
}

std::vector<BrickChange> BoneMirror::take_changes() {
    std::vector<BrickChange> changes;
    changes.reserve(changed_.size());
    for (const auto& [brick, voxels] : changed_) {
        checksum_.update(bone_, bone_.slot(brick));
        changes.push_back({brick, voxels});
    }
    changed_.clear();
    return changes;
}

}  // namespace osteomill
