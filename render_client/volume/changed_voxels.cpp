#include "render_client/volume/changed_voxels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace osteomill {

namespace {

/// A row of a brick along x, as two words whose lowest byte comes first.
using Row = std::array<std::uint64_t, 2>;
static_assert(sizeof(Row) == brick_edge_voxels && std::endian::native == std::endian::little);

Row row_at(const std::uint8_t* voxels) {
    Row row;
    std::memcpy(row.data(), voxels, sizeof(Row));
    return row;
}

/// Within the brick; empty where both are equal.
VoxelBox difference(const std::uint8_t* before, const std::uint8_t* after) {
    Row any{};
    glm::ivec3 low(brick_edge_voxels), high(0);
    for (int z = 0; z < brick_edge_voxels; ++z)
        for (int y = 0; y < brick_edge_voxels; ++y) {
            const std::size_t offset = offset_in_brick({0, y, z});
            const Row was = row_at(before + offset), is = row_at(after + offset);
            const Row changed{was[0] ^ is[0], was[1] ^ is[1]};
            if ((changed[0] | changed[1]) == 0) continue;
            any = {any[0] | changed[0], any[1] | changed[1]};
            low.y = std::min(low.y, y);
            high.y = std::max(high.y, y + 1);
            low.z = std::min(low.z, z);
            high.z = z + 1;
        }
    if (high.z == 0) return {};
    constexpr int word_bytes = 8;
    low.x = any[0] != 0 ? std::countr_zero(any[0]) / word_bytes
                        : word_bytes + std::countr_zero(any[1]) / word_bytes;
    high.x = brick_edge_voxels - (any[1] != 0 ? std::countl_zero(any[1]) / word_bytes
                                              : word_bytes + std::countl_zero(any[0]) / word_bytes);
    return {low, high - low};
}

}  // namespace

ChangedVoxels::ChangedVoxels(const Bone& bone) : known_(bone.stored_bricks()) {
    for (std::size_t slot = 0; slot < known_.size(); ++slot)
        std::ranges::copy(bone.fractions(static_cast<std::int32_t>(slot)), known_[slot].begin());
}

std::span<const VoxelBox> ChangedVoxels::since_last(const Bone& bone, std::span<const BrickIndex> dirty) {
    boxes_.clear();
    for (const BrickIndex index : dirty) {
        const std::int32_t slot = bone.slot(index);
        if (slot == BoneContent::no_slot) continue;
        ByteBrick& known = known_[static_cast<std::size_t>(slot)];
        const auto fractions = bone.fractions(slot);
        const VoxelBox changed = difference(known.data(), fractions.data());
        if (changed.count() == 0) continue;
        const glm::ivec3 first = brick_position(bone.content().size_bricks, index) * brick_edge_voxels;
        boxes_.push_back({first + changed.first, changed.size});
        std::ranges::copy(fractions, known.begin());
    }
    return boxes_;
}

}  // namespace osteomill
