#include "common/bone/brick_change.h"

namespace osteomill {

namespace {

bool reaches_past_grid(const Bone& bone, const glm::ivec3& first_voxel) {
    return !contains(bone.grid(), first_voxel + (brick_edge_voxels - 1));
}

bool may_rise(const BrickChange& change, const Bone& bone, std::size_t voxel) {
    if (change.kind == ChangeKind::milled) return false;
    const glm::ivec3 first = brick_edge_voxels * brick_position(bone.content().size_bricks, change.brick);
    return !reaches_past_grid(bone, first) || contains(bone.grid(), first + voxel_in_brick(voxel));
}

}  // namespace

bool apply(const BrickChange& change, BrickFractions fractions, Bone& bone) {
    const std::int32_t slot = bone.slot(change.brick);
    if (slot == BoneContent::no_slot) return false;
    const auto now = bone.fractions(slot);
    bool is_refused = false;
    change.voxels.for_each([&](std::size_t voxel) {
        if (fractions[voxel] > now[voxel]) is_refused |= !may_rise(change, bone, voxel);
    });
    if (is_refused) return false;
    change.voxels.for_each([&](std::size_t voxel) { now[voxel] = fractions[voxel]; });
    return true;
}

}  // namespace osteomill
