#include <gtest/gtest.h>

#include "haptic_server/streaming/outgoing_frames.h"

namespace osteomill {
namespace {

VoxelMask voxel(std::size_t offset) {
    return VoxelMask().set(offset);
}

TEST(PendingChanges, GathersWhatChangesInABrickUntilItIsSent) {
    PendingChanges pending;
    EXPECT_TRUE(pending.empty());
    pending.add({7, voxel(3)});
    pending.add({7, voxel(4000)});
    EXPECT_EQ(pending.bricks(), 1U);
    EXPECT_EQ(pending.next().brick, 7U);
    EXPECT_EQ(pending.next().voxels, voxel(3) | voxel(4000));
    pending.sent();
    EXPECT_TRUE(pending.empty());
    EXPECT_EQ(pending.masks(), 0U);
}

TEST(PendingChanges, LetsNoBrickWaitForOneThatKeepsChanging) {
    PendingChanges pending;
    for (const BrickIndex brick : {2U, 5U, 0xFFFFFFFFU}) pending.add({brick, voxel(0)});
    std::vector<BrickIndex> order;
    for (int i = 0; i < 5; ++i) {
        order.push_back(pending.next().brick);
        pending.sent();
        pending.add({2, voxel(1)});
    }
    EXPECT_EQ(order, (std::vector<BrickIndex>{2, 5, 0xFFFFFFFF, 2, 2}));
}

TEST(PendingChanges, SendsAWholeBrickWhateverElseIsSaidOfIt) {
    PendingChanges pending;
    pending.add({1, voxel(9)});
    pending.add_whole(1);
    pending.add({1, voxel(10)});
    EXPECT_EQ(pending.masks(), 0U);
    EXPECT_TRUE(pending.next().voxels.all());
    pending.sent();
    EXPECT_TRUE(pending.empty());
}

TEST(PendingChanges, KeepsNoMoreMasksThanItMay) {
    PendingChanges pending;
    constexpr BrickIndex bricks = 3 * PendingChanges::most_masks;
    for (int time = 0; time < 2; ++time)
        for (BrickIndex brick = 0; brick < bricks; ++brick) pending.add({brick, voxel(brick % 4096)});
    EXPECT_EQ(pending.masks(), PendingChanges::most_masks);
    EXPECT_EQ(pending.bricks(), bricks) << "each brick once";
    for (BrickIndex brick = 0; brick < bricks; ++brick) {
        ASSERT_EQ(pending.next().brick, brick);
        ASSERT_TRUE(pending.next().voxels[brick % 4096]) << "nothing is forgotten";
        pending.sent();
    }
    EXPECT_EQ(pending.masks(), 0U);
}

TEST(PendingChanges, SendsAllOfABrickAsRestoredOnceAnyOfItWas) {
    PendingChanges pending;
    pending.add({4, voxel(1)});
    pending.add({4, voxel(2), ChangeKind::restored});
    pending.add({4, voxel(3)});
    EXPECT_EQ(pending.next(), (BrickChange{4, voxel(1) | voxel(2) | voxel(3), ChangeKind::restored}));
    pending.sent();
    pending.add({4, voxel(1)});
    EXPECT_EQ(pending.next().kind, ChangeKind::milled);
}

}  // namespace
}  // namespace osteomill
