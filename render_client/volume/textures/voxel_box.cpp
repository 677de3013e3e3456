#include "render_client/volume/textures/voxel_box.h"

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <stdexcept>

namespace osteomill {

VoxelBox box_of_bricks(const glm::ivec3& size_bricks, std::span<const BrickIndex> bricks) {
    if (bricks.empty()) return {};
    glm::ivec3 low = size_bricks;
    glm::ivec3 high{0};
    for (const BrickIndex index : bricks) {
        const glm::ivec3 brick = brick_position(size_bricks, index);
        low = glm::min(low, brick);
        high = glm::max(high, brick + 1);
    }
    return {low * brick_edge_voxels, (high - low) * brick_edge_voxels};
}

VoxelBox stored_box(const BoneContent& content) {
    return box_of_bricks(content.size_bricks, content.brick_of_slot);
}

std::span<const std::uint8_t, brick_voxel_count> channel_of_slot(const Bone& bone, BoneChannel channel,
                                                                 std::int32_t slot) {
    const auto index = static_cast<std::size_t>(slot);
    switch (channel) {
        case BoneChannel::stiffness:
            return bone.content().stiffness[index];
        case BoneChannel::tissue:
            return bone.content().tissue[index];
        case BoneChannel::fraction:
            break;
    }
    return bone.fractions(slot);
}

void copy_channel(const Bone& bone, BoneChannel channel, const VoxelBox& box,
                  std::span<std::uint8_t> voxels) {
    if (voxels.size() != box.count()) throw std::invalid_argument("a box copy of the wrong length");
    std::fill(voxels.begin(), voxels.end(), std::uint8_t{0});
    const glm::ivec3 end = box.first + box.size;
    const glm::ivec3 first_brick = glm::max(box.first, 0) / brick_edge_voxels;
    const glm::ivec3 end_brick =
        glm::min((end + (brick_edge_voxels - 1)) / brick_edge_voxels, bone.content().size_bricks);

    for (int bz = first_brick.z; bz < end_brick.z; ++bz)
        for (int by = first_brick.y; by < end_brick.y; ++by)
            for (int bx = first_brick.x; bx < end_brick.x; ++bx) {
                const glm::ivec3 brick(bx, by, bz);
                const std::int32_t slot = bone.slot(brick);
                if (slot == BoneContent::no_slot) continue;
                const auto source = channel_of_slot(bone, channel, slot);
                const glm::ivec3 low = glm::max(brick * brick_edge_voxels, box.first);
                const glm::ivec3 high = glm::min((brick + 1) * brick_edge_voxels, end);
                if (high.x <= low.x) continue;
                for (int z = low.z; z < high.z; ++z)
                    for (int y = low.y; y < high.y; ++y) {
                        const glm::ivec3 to = glm::ivec3(low.x, y, z) - box.first;
                        const std::size_t row =
                            (static_cast<std::size_t>(to.z) * box.size.y + to.y) * box.size.x + to.x;
                        const std::uint8_t* const from = source.data() + offset_in_brick({low.x, y, z});
                        // Most rows are whole, and of a length that the compiler knows.
                        if (high.x - low.x == brick_edge_voxels)
                            std::memcpy(voxels.data() + row, from, brick_edge_voxels);
                        else
                            std::copy_n(from, high.x - low.x, voxels.data() + row);
                    }
            }
}

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
