#include "common/bone/brick.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace osteomill::brick_test {
namespace {

TEST(Brick, IndexAndPositionAreInverse) {
    const glm::ivec3 size(5, 3, 7);
    BrickIndex expected = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                EXPECT_EQ(brick_index(size, {x, y, z}), expected);
                EXPECT_EQ(brick_position(size, expected), glm::ivec3(x, y, z));
                ++expected;
            }
}

TEST(Brick, LastBrickReachesPastAnOddGrid) {
    EXPECT_EQ(size_in_bricks(Grid{.size_voxels = {16, 17, 33}}), glm::ivec3(1, 2, 3));
}

TEST(Brick, OffsetRunsAlongXFirst) {
    EXPECT_EQ(offset_in_brick({0, 0, 0}), 0U);
    EXPECT_EQ(offset_in_brick({17, 0, 0}), 1U);
    EXPECT_EQ(offset_in_brick({0, 18, 0}), 32U);
    EXPECT_EQ(offset_in_brick({15, 15, 31}), 4095U);
}

TEST(Brick, VoxelOfAnOffsetIsTheReverseOfTheOffsetOfAVoxel) {
    EXPECT_EQ(voxel_in_brick(1), glm::ivec3(1, 0, 0));
    EXPECT_EQ(voxel_in_brick(32), glm::ivec3(0, 2, 0));
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
        EXPECT_EQ(offset_in_brick(voxel_in_brick(offset)), offset);
        EXPECT_TRUE(contains(Grid{.size_voxels = glm::ivec3(brick_edge_voxels)}, voxel_in_brick(offset)));
    }
}

TEST(Grid, VoxelCentresAndCoordinatesAreInverse) {
    const Grid grid{.size_voxels = {8, 8, 8}, .spacing_mm = 0.25, .origin_mm = {-3.0, 5.0, 0.5}};
    const glm::ivec3 voxel(7, 2, 4);
    EXPECT_EQ(to_voxel_coordinates(grid, centre_of_voxel_mm(grid, voxel)), glm::dvec3(voxel));
    EXPECT_EQ(centre_of_voxel_mm(grid, {0, 0, 0}), grid.origin_mm);
}

TEST(Grid, RefusesWhatIsNoGrid) {
    EXPECT_THROW(require_valid(Grid{.size_voxels = {0, 8, 8}}), std::invalid_argument);
    EXPECT_THROW(require_valid(Grid{.size_voxels = {8, 8, 65537}}), std::invalid_argument);
    EXPECT_THROW(require_valid(Grid{.size_voxels = {8, 8, 8}, .spacing_mm = 0.0}), std::invalid_argument);
    EXPECT_THROW(require_valid(Grid{.size_voxels = {8, 8, 8},
                                    .spacing_mm = 0.1,
                                    .origin_mm = {0, 0, std::numeric_limits<double>::quiet_NaN()}}),
                 std::invalid_argument);
    EXPECT_NO_THROW(require_valid(Grid{.size_voxels = {8, 8, 8}}));
}

TEST(Grid, HoldsNoMoreBricksThanAnIndexCanNumber) {
    EXPECT_THROW(require_valid(Grid{.size_voxels = {65536, 65536, 4097}}), std::invalid_argument);
    const Grid largest{.size_voxels = {65536, 65536, 4096}};
    EXPECT_NO_THROW(require_valid(largest));
    const glm::ivec3 bricks = size_in_bricks(largest);
    EXPECT_EQ(brick_index(bricks, bricks - 1), std::numeric_limits<BrickIndex>::max());
    EXPECT_EQ(brick_position(bricks, std::numeric_limits<BrickIndex>::max()), bricks - 1);
}

}  // namespace
}  // namespace osteomill::brick_test
