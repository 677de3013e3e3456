#include <gtest/gtest.h>

#include <algorithm>

#include "common/wire/session_receiver.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

class FollowedStateTest : public ::testing::Test {
  protected:
    /// A change of these voxels, with the fractions of the server's brick.
    ChangedBrick told(const VoxelMask& voxels) const {
        ChangedBrick changed{.change = {brick_, voxels}};
        std::ranges::copy(servers_.fractions(3), changed.fractions.begin());
        return changed;
    }
    /// Halves the first voxel of that brick, and reports it.
    StateArrived halve_a_voxel() {
        servers_.fractions(3)[0] /= 2;
        return {.changes = {told(VoxelMask().set(0))}, .bone_checksum = checksum(servers_)};
    }
    FollowedState followed(const StateArrived& arrived) {
        const auto outcome = follow(arrived, replica_);
        EXPECT_TRUE(std::holds_alternative<FollowedState>(outcome));
        return std::get<FollowedState>(outcome);
    }

    Bone servers_ = testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1);
    const BrickIndex brick_ = servers_.content().brick_of_slot[3];
    BoneReplica replica_{servers_};
};

TEST_F(FollowedStateTest, FollowsAndVerifies) {
    const FollowedState state = followed(halve_a_voxel());
    EXPECT_EQ(state.check, ReplicaCheck::equal);
    EXPECT_FALSE(state.has_regained_bone);
    EXPECT_EQ(checksum(replica_.bone()), checksum(servers_));
    EXPECT_EQ(replica_.checksum(), checksum(servers_));
    EXPECT_EQ(replica_.take_changes(), std::vector{told(VoxelMask().set(0)).change});
}

TEST_F(FollowedStateTest, SaysThatItDiffersAfterAChangeWasLost) {
    halve_a_voxel();
    StateArrived arrived = halve_a_voxel();
    arrived.changes.clear();
    EXPECT_EQ(followed(arrived).check, ReplicaCheck::differs);
}

TEST_F(FollowedStateTest, TakesBackBoneThatItHadLostAndSaysSo) {
    replica_.set_fractions(brick_, ByteBrick{});
    StateArrived arrived = halve_a_voxel();
    arrived.changes = {told(VoxelMask().set_all())};
    const FollowedState state = followed(arrived);
    EXPECT_TRUE(state.has_regained_bone);
    EXPECT_EQ(state.check, ReplicaCheck::equal);
}

TEST_F(FollowedStateTest, FindsNothingWrongWithBoneThatIsRestored) {
    const ChangedBrick before = told(VoxelMask().set(0));
    followed(halve_a_voxel());
    StateArrived undone{.changes = {before}};
    undone.changes[0].change.kind = ChangeKind::restored;
    EXPECT_FALSE(followed(undone).has_regained_bone);
    EXPECT_EQ(replica_.bone().fractions(3)[0], before.fractions[0]);
}

TEST_F(FollowedStateTest, RefusesWhatDoesNotFit) {
    StateArrived arrived = halve_a_voxel();
    arrived.changes[0].change.brick = 1'000'000;
    const auto outcome = follow(arrived, replica_);
    ASSERT_TRUE(std::holds_alternative<WireError>(outcome));
    EXPECT_EQ(std::get<WireError>(outcome).line, "change of brick 1000000 refused: no bone is stored there");
}

TEST_F(FollowedStateTest, IsPutBackToWhatItWas) {
    const std::uint64_t before = replica_.checksum();
    const ByteBrick whole = told({}).fractions;
    followed(halve_a_voxel());
    EXPECT_NE(replica_.checksum(), before);
    replica_.take_changes();
    replica_.set_fractions(brick_, whole);
    EXPECT_EQ(replica_.take_changes(), std::vector{told(VoxelMask().set(0)).change})
        << "what was as it is now did not change";
    EXPECT_EQ(replica_.checksum(), before);
    EXPECT_EQ(checksum(replica_.bone()), before);
}

}  // namespace
}  // namespace osteomill
