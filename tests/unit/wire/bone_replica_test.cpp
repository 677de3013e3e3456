#include "common/wire/bone_replica.h"

#include <gtest/gtest.h>

#include "tests/support/block.h"
#include "tests/support/random_carving.h"
#include "tests/support/replica_sink.h"

namespace osteomill {
namespace {

using testing::ReplicaSink;

TEST(BoneReplica, FollowsTheBoneAndKnowsItsChecksum) {
    Bone bone = testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1);
    BoneReplica mirror(bone);
    ReplicaSink sink(mirror);
    std::mt19937 random(1);
    for (int round = 0; round < 20; ++round) {
        for (int i = 0; i < 100; ++i) testing::carve_somewhere(bone, random, sink);
        mirror.take_changes();
        ASSERT_EQ(mirror.checksum(), checksum(bone));
    }
}

TEST(BoneReplica, TellsOfChangesOnce) {
    BoneReplica mirror(testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1));
    ByteBrick left{};
    left[20] = 9;
    EXPECT_TRUE(mirror.apply({1, VoxelMask().set(20).set(21)}, left));
    EXPECT_TRUE(mirror.apply({1, VoxelMask().set(21).set(40)}, left));
    BrickChange expected{.brick = 1};
    expected.voxels.set(20).set(21).set(40);
    EXPECT_EQ(mirror.take_changes(), std::vector{expected});
    EXPECT_TRUE(mirror.take_changes().empty());
}

TEST(BoneReplica, RefusesAChangeThatDoesNotFit) {
    BoneReplica mirror(testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1));
    const std::uint64_t before = mirror.checksum();
    EXPECT_FALSE(mirror.apply({1000, VoxelMask().set(0)}, ByteBrick{}));
    EXPECT_TRUE(mirror.take_changes().empty());
    EXPECT_EQ(mirror.checksum(), before);
}

}  // namespace
}  // namespace osteomill
