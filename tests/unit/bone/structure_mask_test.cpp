#include "common/bone/structure_mask.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace osteomill {
namespace {

const Grid grid{.size_voxels = {40, 20, 33}, .spacing_mm = 0.5, .origin_mm = {1.0, 2.0, 3.0}};

TEST(StructureMask, KnowsItsVoxelsVolumeAndBounds) {
    // Bricks of this grid: 3 x 2 x 3. Voxel (17, 1, 0) is in brick 1, voxel (3, 18, 32) in brick 15.
    const StructureMask mask(grid, {{1, VoxelMask().set(offset_in_brick({17, 1, 0}))},
                                    {15, VoxelMask().set(offset_in_brick({3, 18, 32}))}});
    EXPECT_TRUE(mask.contains({17, 1, 0}));
    EXPECT_TRUE(mask.contains({3, 18, 32}));
    EXPECT_FALSE(mask.contains({3, 18, 31}));
    EXPECT_FALSE(mask.contains({-1, 0, 0}));
    EXPECT_EQ(mask.voxel_count(), 2U);
    EXPECT_DOUBLE_EQ(mask.volume_mm3(), 0.25);
    EXPECT_EQ(*mask.bounds(), (VoxelBounds{{3, 1, 0}, {17, 18, 32}}));
    EXPECT_LT(mask.memory_bytes(), 2000U);
}

TEST(StructureMask, LeavesOutBricksWithoutVoxels) {
    const StructureMask mask(grid, {{0, VoxelMask()}, {4, VoxelMask()}});
    EXPECT_TRUE(mask.empty());
    EXPECT_FALSE(mask.bounds());
    EXPECT_EQ(mask.volume_mm3(), 0.0);
}

TEST(StructureMask, RefusesBricksOutOfOrderAndVoxelsPastTheEdge) {
    const VoxelMask one = VoxelMask().set(0);
    EXPECT_THROW(StructureMask(grid, {{2, one}, {1, one}}), std::invalid_argument);
    EXPECT_THROW(StructureMask(grid, {{2, one}, {2, one}}), std::invalid_argument);
    EXPECT_THROW(StructureMask(grid, {{18, one}}), std::invalid_argument);
    EXPECT_THROW(StructureMask(grid, {{2, VoxelMask().set(15)}}), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill
