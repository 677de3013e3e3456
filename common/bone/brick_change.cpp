#include "common/bone/brick_change.h"

#include <span>

namespace osteomill {

namespace {

/// Voxels that would rise: whether there is any, and whether any lies beyond the grid's edge.
struct Rise {
    bool any = false;
    bool outside_grid = false;
};

Rise rise_of(const BrickChange& change, BrickFractions fractions, const Bone& bone, std::int32_t slot) {
    const auto now = bone.fractions(slot);
    const glm::ivec3 first = brick_edge_voxels * brick_position(bone.content().size_bricks, change.brick);
    const bool reaches_past_grid = !contains(bone.grid(), first + (brick_edge_voxels - 1));
    Rise rise;
    change.voxels.for_each([&](std::size_t voxel) {
        if (fractions[voxel] <= now[voxel]) return;
        rise.any = true;
        rise.outside_grid |= reaches_past_grid && !contains(bone.grid(), first + voxel_in_brick(voxel));
    });
    return rise;
}

void write(const BrickChange& change, BrickFractions fractions, std::span<std::uint8_t> to) {
    change.voxels.for_each([&](std::size_t voxel) { to[voxel] = fractions[voxel]; });
}

}  // namespace

bool apply(const BrickChange& change, BrickFractions fractions, Bone& bone) {
    const std::int32_t slot = bone.slot(change.brick);
    if (slot == BoneContent::no_slot) return false;
    const Rise rise = rise_of(change, fractions, bone, slot);
    if (change.kind == ChangeKind::milled ? rise.any : rise.outside_grid) return false;
    write(change, fractions, bone.fractions(slot));
    return true;
}

Correction correct(const BrickChange& change, BrickFractions fractions, Bone& bone) {
    const std::int32_t slot = bone.slot(change.brick);
    if (slot == BoneContent::no_slot) return Correction::not_stored;
    const Rise rise = rise_of(change, fractions, bone, slot);
    if (rise.outside_grid) return Correction::outside_grid;
    write(change, fractions, bone.fractions(slot));
    return rise.any ? Correction::raises : Correction::lowers;
}

}  // namespace osteomill
