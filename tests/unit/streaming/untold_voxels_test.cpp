#include "haptic_server/streaming/untold_voxels.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

VoxelMask voxel(std::size_t offset) {
    return VoxelMask().set(offset);
}

TEST(UntoldVoxels, GathersWhatChangesInABrickUntilItIsTold) {
    UntoldVoxels untold;
    EXPECT_TRUE(untold.empty());
    untold.add(7, voxel(3));
    untold.add(7, voxel(4000));
    EXPECT_EQ(untold.bricks(), 1U);
    EXPECT_EQ(untold.next().brick, 7U);
    EXPECT_EQ(untold.next().voxels, voxel(3) | voxel(4000));
    untold.told();
    EXPECT_TRUE(untold.empty());
    EXPECT_EQ(untold.masks(), 0U);
}

TEST(UntoldVoxels, LetsNoBrickWaitForOneThatKeepsChanging) {
    UntoldVoxels untold;
    for (const BrickIndex brick : {2U, 5U, 0xFFFFFFFFU}) untold.add(brick, voxel(0));
    std::vector<BrickIndex> order;
    for (int i = 0; i < 5; ++i) {
        order.push_back(untold.next().brick);
        untold.told();
        untold.add(2, voxel(1));
    }
    EXPECT_EQ(order, (std::vector<BrickIndex>{2, 5, 0xFFFFFFFF, 2, 2}));
}

TEST(UntoldVoxels, TellsAWholeBrickWhateverElseIsSaidOfIt) {
    UntoldVoxels untold;
    untold.add(1, voxel(9));
    untold.add_whole(1);
    untold.add(1, voxel(10));
    EXPECT_EQ(untold.masks(), 0U);
    EXPECT_TRUE(untold.next().voxels.all());
    untold.told();
    EXPECT_TRUE(untold.empty());
}

TEST(UntoldVoxels, KeepsNoMoreMasksThanItMay) {
    UntoldVoxels untold;
    constexpr BrickIndex bricks = 3 * UntoldVoxels::most_masks;
    for (int time = 0; time < 2; ++time)
        for (BrickIndex brick = 0; brick < bricks; ++brick) untold.add(brick, voxel(brick % 4096));
    EXPECT_EQ(untold.masks(), UntoldVoxels::most_masks);
    EXPECT_EQ(untold.bricks(), bricks) << "each brick once";
    for (BrickIndex brick = 0; brick < bricks; ++brick) {
        ASSERT_EQ(untold.next().brick, brick);
        ASSERT_TRUE(untold.next().voxels[brick % 4096]) << "nothing is forgotten";
        untold.told();
    }
    EXPECT_EQ(untold.masks(), 0U);
}

}  // namespace
}  // namespace osteomill
