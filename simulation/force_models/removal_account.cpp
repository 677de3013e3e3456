#include "simulation/force_models/removal_account.h"

#include <algorithm>

namespace osteomill {

void restore_bone(const BrickChange& change, BrickFractions fractions, Bone& bone, RemovalAccount& account,
                  ChangeSink& changes) noexcept {
    const std::int32_t slot = bone.slot(change.brick);
    if (slot == BoneContent::no_slot) return;
    const ByteBrick before = [&] {
        ByteBrick copy;
        std::ranges::copy(bone.fractions(slot), copy.begin());
        return copy;
    }();
    const BrickChange restored{change.brick, change.voxels, ChangeKind::restored};
    if (!apply(restored, fractions, bone)) return;
    change.voxels.for_each([&](std::size_t voxel) {
        account.restore(bone.content().tissue_in(slot, voxel),
                        static_cast<double>(fractions[voxel]) - static_cast<double>(before[voxel]));
    });
    changes.push(restored, bone.fractions(slot));
}

}  // namespace osteomill
