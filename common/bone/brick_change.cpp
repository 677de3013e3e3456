#include "common/bone/brick_change.h"

namespace osteomill {

bool apply(const BrickChange& change, BrickFractions fractions, Bone& bone) {
    const std::int32_t slot = bone.slot(change.brick);
    if (slot == BoneContent::no_slot) return false;
    const auto now = bone.fractions(slot);
    bool raises = false;
    change.voxels.for_each([&](std::size_t voxel) { raises |= fractions[voxel] > now[voxel]; });
    if (raises) return false;
    change.voxels.for_each([&](std::size_t voxel) { now[voxel] = fractions[voxel]; });
    return true;
}

}  // namespace osteomill
