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

ChangedVoxels BoneMirror::take_changes() {
    for (const auto& [brick, mask] : changed_) checksum_.update(bone_, bone_.slot(brick));
    return std::exchange(changed_, {});
}

}  // namespace osteomill
