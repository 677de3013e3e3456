#include "render_client/volume/changed_blocks.h"

#include <xxhash.h>

#include <cstring>
#include <glm/common.hpp>

namespace osteomill {

namespace {

constexpr std::size_t block_edge = block_edge_voxels;
constexpr std::size_t block_voxels = block_edge * block_edge * block_edge;
constexpr glm::ivec3 blocks_of_brick(blocks_per_brick_edge);

std::size_t place_in_brick(const glm::ivec3& block) {
    return static_cast<std::size_t>(block.x +
                                    blocks_per_brick_edge * (block.y + blocks_per_brick_edge * block.z));
}

}  // namespace

ChangedBlocks::BlockHashes ChangedBlocks::hashes_of(
    std::span<const std::uint8_t, brick_voxel_count> fractions) {
    BlockHashes hashes;
    std::array<std::array<std::uint8_t, block_voxels>, blocks_per_brick_edge> along_x;
    glm::ivec3 block(0);
    for (block.z = 0; block.z < blocks_per_brick_edge; ++block.z)
        for (block.y = 0; block.y < blocks_per_brick_edge; ++block.y) {
            std::size_t gathered = 0;
            for (int z = 0; z < block_edge_voxels; ++z)
                for (int y = 0; y < block_edge_voxels; ++y, gathered += block_edge) {
                    const glm::ivec3 row(0, block_edge_voxels * block.y + y, block_edge_voxels * block.z + z);
                    const std::uint8_t* const voxels = fractions.data() + offset_in_brick(row);
                    for (std::size_t x = 0; x < along_x.size(); ++x)
                        std::memcpy(along_x[x].data() + gathered, voxels + block_edge * x, block_edge);
                }
            block.x = 0;
            const std::size_t first = place_in_brick(block);
            for (std::size_t x = 0; x < along_x.size(); ++x)
                hashes[first + x] = XXH3_64bits(along_x[x].data(), block_voxels);
        }
    return hashes;
}

ChangedBlocks::ChangedBlocks(const Bone& bone) : known_(bone.stored_bricks()) {
    for (std::size_t slot = 0; slot < known_.size(); ++slot)
        known_[slot] = hashes_of(bone.fractions(static_cast<std::int32_t>(slot)));
}

std::span<const VoxelBox> ChangedBlocks::since_last(const Bone& bone, std::span<const BrickIndex> dirty) {
    boxes_.clear();
    for (const BrickIndex index : dirty) {
        const std::int32_t slot = bone.slot(index);
        if (slot == BoneContent::no_slot) continue;
        BlockHashes& known = known_[static_cast<std::size_t>(slot)];
        const BlockHashes hashes = hashes_of(bone.fractions(slot));
        glm::ivec3 low = blocks_of_brick, high(0), block;
        for (block.z = 0; block.z < blocks_per_brick_edge; ++block.z)
            for (block.y = 0; block.y < blocks_per_brick_edge; ++block.y)
                for (block.x = 0; block.x < blocks_per_brick_edge; ++block.x) {
                    const std::size_t place = place_in_brick(block);
                    if (hashes[place] == known[place]) continue;
                    low = glm::min(low, block);
                    high = glm::max(high, block + 1);
                }
        known = hashes;
        if (high.x == 0) continue;
        const glm::ivec3 first = brick_position(bone.content().size_bricks, index) * brick_edge_voxels;
        boxes_.push_back({first + block_edge_voxels * low, block_edge_voxels * (high - low)});
    }
    return boxes_;
}

}  // namespace osteomill
