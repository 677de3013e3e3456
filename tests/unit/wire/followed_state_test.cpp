#include "common/wire/followed_state.h"

#include <gtest/gtest.h>

#include "common/wire/brick_edit.h"
#include "common/wire/scene_messages.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

class FollowedStateTest : public ::testing::Test {
  protected:
    /// Halves the first voxel of a brick of the server's bone, and tells of it.
    v1::StateFrame halve_a_voxel() {
        const BrickIndex brick = servers_.content().brick_of_slot[3];
        servers_.fractions(3)[0] /= 2;
        v1::StateFrame frame;
        *frame.mutable_tool() = to_message(ToolState{.time_s = 1.5});
        *frame.add_edits() = brick_edit({brick, VoxelMask().set(0)}, servers_.fractions(3));
        frame.set_bone_checksum(checksum(servers_));
        return frame;
    }

    Bone servers_ = testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1);
    SessionInfo session_{.burrs = {Burr{}}, .tissues = {Tissue{.label = 1, .is_protected = true}}};
    BoneReplica replica_{servers_};
};

TEST_F(FollowedStateTest, FollowsAndVerifies) {
    const auto outcome = follow(halve_a_voxel(), session_, replica_);
    ASSERT_TRUE(std::holds_alternative<FollowedState>(outcome));
    EXPECT_EQ(std::get<FollowedState>(outcome).check, ReplicaCheck::equal);
    EXPECT_FALSE(std::get<FollowedState>(outcome).has_regained_bone);
    EXPECT_EQ(std::get<FollowedState>(outcome).tool.time_s, 1.5);
    EXPECT_EQ(checksum(replica_.bone()), checksum(servers_));
    EXPECT_EQ(replica_.checksum(), checksum(servers_));
    BrickChange expected{.brick = servers_.content().brick_of_slot[3]};
    expected.voxels.set(0);
    EXPECT_EQ(replica_.take_changes(), std::vector{expected});
}

TEST_F(FollowedStateTest, SaysThatItDiffersAfterAnEditWasLost) {
    halve_a_voxel();
    auto frame = halve_a_voxel();
    frame.clear_edits();
    const auto outcome = follow(frame, session_, replica_);
    ASSERT_TRUE(std::holds_alternative<FollowedState>(outcome));
    EXPECT_EQ(std::get<FollowedState>(outcome).check, ReplicaCheck::differs);
}

TEST_F(FollowedStateTest, TakesBackBoneThatItHadLostAndSaysSo) {
    const BrickIndex brick = servers_.content().brick_of_slot[3];
    replica_.set_fractions(brick, ByteBrick{});
    v1::StateFrame frame = halve_a_voxel();
    *frame.mutable_edits(0) = brick_edit({brick, VoxelMask().set_all()}, servers_.fractions(3));
    const auto outcome = follow(frame, session_, replica_);
    ASSERT_TRUE(std::holds_alternative<FollowedState>(outcome));
    EXPECT_TRUE(std::get<FollowedState>(outcome).has_regained_bone);
    EXPECT_EQ(std::get<FollowedState>(outcome).check, ReplicaCheck::equal);
}

TEST_F(FollowedStateTest, RefusesWhatMakesNoSense) {
    auto frame = halve_a_voxel();
    frame.mutable_tool()->set_burr(1);
    EXPECT_TRUE(std::holds_alternative<WireError>(follow(frame, session_, replica_)));
    frame.mutable_tool()->set_burr(0);
    frame.mutable_edits(0)->set_brick(1'000'000);
    EXPECT_TRUE(std::holds_alternative<WireError>(follow(frame, session_, replica_)));
}

TEST_F(FollowedStateTest, IsPutBackToWhatItWas) {
    const std::uint64_t before = replica_.checksum();
    const ByteBrick whole = [&] {
        ByteBrick brick;
        std::ranges::copy(servers_.fractions(3), brick.begin());
        return brick;
    }();
    ASSERT_TRUE(std::holds_alternative<FollowedState>(follow(halve_a_voxel(), session_, replica_)));
    EXPECT_NE(replica_.checksum(), before);
    const BrickIndex brick = servers_.content().brick_of_slot[3];
    replica_.take_changes();
    replica_.set_fractions(brick, whole);
    BrickChange expected{.brick = brick};
    expected.voxels.set(0);
    EXPECT_EQ(replica_.take_changes(), std::vector{expected}) << "what was as it is now did not change";
    EXPECT_EQ(replica_.checksum(), before);
    EXPECT_EQ(checksum(replica_.bone()), before);
}

}  // namespace
}  // namespace osteomill
