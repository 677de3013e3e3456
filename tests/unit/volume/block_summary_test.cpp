#include <gtest/gtest.h>

#include <random>

#include "render_client/volume/textures/empty_space.h"

namespace osteomill::block_summary_test {
namespace {

ByteBrick sparse_noise() {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> byte(0, 255), chance(0, 40);
    ByteBrick brick{};
    // Most voxels are less than half full, so that many blocks reach only some of their neighbours.
    for (std::uint8_t& voxel : brick)
        voxel = static_cast<std::uint8_t>(chance(random) == 0 ? byte(random) : byte(random) / 2);
    return brick;
}

bool touches(int place, int side) {
    return side == 0 || place == (side < 0 ? 0 : block_edge_voxels - 1);
}

TEST(BlockSummary, AgreesWithItsDefinitionVoxelByVoxel) {
    const ByteBrick brick = sparse_noise();
    const BrickSummary summary = summary_of_brick(brick);
    for (std::size_t block = 0; block < blocks_per_brick; ++block) {
        const glm::ivec3 first = block_edge_voxels * glm::ivec3(block & 3, block >> 2 & 3, block >> 4);
        BlockReach reach = 0;
        int sum = 0;
        for (int voxel = 0; voxel < 64; ++voxel) {
            const glm::ivec3 place(voxel & 3, voxel >> 2 & 3, voxel >> 4);
            const std::uint8_t fraction = brick[offset_in_brick(first + place)];
            sum += fraction;
            for (int bit = 0; bit < 27 && fraction >= 128; ++bit) {
                const glm::ivec3 side = neighbour_of_bit(bit);
                if (touches(place.x, side.x) && touches(place.y, side.y) && touches(place.z, side.z))
                    reach |= 1U << bit;
            }
        }
        ASSERT_EQ(summary.reach[block], reach) << "block " << block;
        ASSERT_EQ(summary.mean_fraction[block], sum / 64) << "block " << block;
    }
}

TEST(BlockSummary, OfAFullBrickReachesAllAroundAndOfAnEmptyOneNowhere) {
    ByteBrick full;
    full.fill(255);
    EXPECT_EQ(summary_of_brick(full).reach[21], (1U << 27) - 1);
    EXPECT_EQ(summary_of_brick(full).mean_fraction[21], 255);
    EXPECT_EQ(summary_of_brick(ByteBrick{}).reach[21], 0U);
}

}  // namespace
}  // namespace osteomill::block_summary_test
