#include "common/bone/structure_mask.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace osteomill {

StructureMask::StructureMask(const Grid& grid, std::vector<StructureBrick> bricks)
    : grid_(grid), bricks_(std::move(bricks)) {
    require_valid(grid);
    const glm::ivec3 size = size_in_bricks(grid);
    const std::uint64_t count = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) *
                                static_cast<std::uint64_t>(size.z);
    std::optional<BrickIndex> before;
    for (const StructureBrick& one : bricks_) {
        if (one.brick >= count || (before && one.brick <= *before))
            throw std::invalid_argument("structure: brick " + std::to_string(one.brick) +
                                        " lies outside the grid or out of order");
        before = one.brick;
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, one.brick);
        const glm::ivec3 end = first + brick_edge_voxels;
        if (end.x <= grid.size_voxels.x && end.y <= grid.size_voxels.y && end.z <= grid.size_voxels.z)
            continue;
        one.voxels.for_each([&](std::size_t offset) {
            if (!osteomill::contains(grid, first + voxel_in_brick(offset)))
                throw std::invalid_argument("structure: a voxel of brick " + std::to_string(one.brick) +
                                            " lies past the grid's edge");
        });
    }
    std::erase_if(bricks_, [](const StructureBrick& one) { return one.voxels.none(); });
    bricks_.shrink_to_fit();
}

bool StructureMask::contains(const glm::ivec3& voxel) const {
    if (!osteomill::contains(grid_, voxel)) return false;
    const BrickIndex brick = brick_index(size_in_bricks(grid_), voxel / brick_edge_voxels);
    const auto found = std::ranges::lower_bound(bricks_, brick, {}, &StructureBrick::brick);
    return found != bricks_.end() && found->brick == brick && found->voxels[offset_in_brick(voxel)];
}

std::uint64_t StructureMask::voxel_count() const {
    std::uint64_t sum = 0;
    for (const StructureBrick& one : bricks_) sum += one.voxels.count();
    return sum;
}

std::optional<VoxelBounds> StructureMask::bounds() const {
    if (empty()) return std::nullopt;
    const glm::ivec3 size = size_in_bricks(grid_);
    VoxelBounds box{glm::ivec3(std::numeric_limits<int>::max()), glm::ivec3(-1)};
    for (const StructureBrick& one : bricks_) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, one.brick);
        one.voxels.for_each([&](std::size_t offset) {
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            box.first = glm::min(box.first, voxel);
            box.last = glm::max(box.last, voxel);
        });
    }
    return box;
}

StructureMask structure_in_bone(const Bone& bone, std::uint8_t label) {
    const BoneContent& content = bone.content();
    std::vector<StructureBrick> bricks;
    for (std::size_t slot = 0; slot < content.tissue.size(); ++slot) {
        VoxelMask voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (content.tissue[slot][offset] == label) voxels.set(offset);
        if (voxels.any()) bricks.push_back({content.brick_of_slot[slot], voxels});
    }
    return {bone.grid(), std::move(bricks)};
}

bool brick_has_label(const Bone& bone, std::size_t slot, std::uint8_t label) {
    const ByteBrick& labels = bone.content().tissue[slot];
    auto at = std::ranges::find(labels, label);
    if (at == labels.end()) return false;
    const BrickFractions fractions = bone.fractions(static_cast<std::int32_t>(slot));
    for (; at != labels.end(); ++at)
        if (*at == label && fractions[static_cast<std::size_t>(at - labels.begin())] > 0) return true;
    return false;
}

}  // namespace osteomill
