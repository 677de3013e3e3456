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
    EXPECT_TRUE(mirror.apply({.brick = 1, .first_voxel = 20, .count = 2, .fraction = {9, 8}}));
    EXPECT_TRUE(mirror.apply({.brick = 1, .first_voxel = 40, .count = 1, .fraction = {7}}));
    BrickChange expected{.brick = 1};
    expected.voxels.set(20).set(21).set(40);
    EXPECT_EQ(mirror.take_changes(), std::vector{expected});
    EXPECT_TRUE(mirror.take_changes().empty());
}

TEST(BoneReplica, RefusesARunThatDoesNotFit) {
    BoneReplica mirror(testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1));
    const std::uint64_t before = mirror.checksum();
    EXPECT_FALSE(mirror.apply({.brick = 1000, .first_voxel = 0, .count = 1}));
    EXPECT_TRUE(mirror.take_changes().empty());
    EXPECT_EQ(mirror.checksum(), before);
}

}  // namespace
}  // namespace osteomill
