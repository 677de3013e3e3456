#include "render_client/volume/textures/changed_boxes.h"

#include <glm/common.hpp>

namespace osteomill {

namespace {

/// Texels go to the driver by the word.
constexpr int group_voxels = 4;

}  // namespace

std::vector<VoxelBox> changed_boxes(const BoneContent& content, std::span<const BrickChange> changes) {
    std::vector<VoxelBox> boxes;
    boxes.reserve(changes.size());
    for (const auto& [brick, voxels, kind] : changes) {
        if (content.slot_of_brick.find(brick) == BoneContent::no_slot || voxels.none()) continue;
        glm::ivec3 low(brick_edge_voxels);
        glm::ivec3 high(-1);
        voxels.for_each([&](std::size_t offset) {
            low = glm::min(low, voxel_in_brick(offset));
            high = glm::max(high, voxel_in_brick(offset));
        });
        low.x -= low.x % group_voxels;
        high.x += group_voxels - 1 - high.x % group_voxels;
        const glm::ivec3 first = brick_position(content.size_bricks, brick) * brick_edge_voxels;
        boxes.push_back({first + low, high - low + 1});
    }
    return boxes;
}

}  // namespace osteomill
