#include "common/wire/bone_follower.h"

#include <gtest/gtest.h>

#include "common/wire/brick_edit.h"
#include "common/wire/scene_messages.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

class BoneFollowerTest : public ::testing::Test {
  protected:
    /// Halves the first voxel of a brick of the server's bone, and tells of it.
    v1::StateFrame halve_a_voxel() {
        const BrickIndex brick = servers_.content().brick_of_slot[3];
        servers_.fractions(3)[0] /= 2;
        VoxelMask changed;
        changed.set(0);
        v1::StateFrame frame;
        *frame.mutable_tool() = to_message(ToolView{.time_s = 1.5});
        *frame.add_edits() = brick_edit(brick, servers_.fractions(3), changed);
        frame.set_bone_checksum(checksum(servers_));
        return frame;
    }

    Bone servers_ = testing::make_block({0, 0, 0}, {4, 4, 4}, 0.1);
    BoneFollower follower_{BoneArrived{servers_, RunningChecksum(servers_)}, 1};
    std::vector<BrickIndex> dirty_;
};

TEST_F(BoneFollowerTest, FollowsAndVerifies) {
    const auto outcome = follower_.apply(halve_a_voxel(), dirty_);
    ASSERT_TRUE(std::holds_alternative<BoneFollower::Applied>(outcome));
    EXPECT_EQ(std::get<BoneFollower::Applied>(outcome).check, CopyCheck::equal);
    EXPECT_FALSE(std::get<BoneFollower::Applied>(outcome).has_regained_bone);
    EXPECT_EQ(std::get<BoneFollower::Applied>(outcome).tool.time_s, 1.5);
    EXPECT_EQ(checksum(follower_.bone()), checksum(servers_));
    EXPECT_EQ(follower_.checksum(), checksum(servers_));
    EXPECT_EQ(dirty_, std::vector<BrickIndex>{servers_.content().brick_of_slot[3]});
}

TEST_F(BoneFollowerTest, SaysThatItDiffersAfterAnEditWasLost) {
    halve_a_voxel();
    auto frame = halve_a_voxel();
    frame.clear_edits();
    const auto outcome = follower_.apply(frame, dirty_);
    ASSERT_TRUE(std::holds_alternative<BoneFollower::Applied>(outcome));
    EXPECT_EQ(std::get<BoneFollower::Applied>(outcome).check, CopyCheck::differs);
}

TEST_F(BoneFollowerTest, TakesBackBoneThatItHadLostAndSaysSo) {
    const BrickIndex brick = servers_.content().brick_of_slot[3];
    follower_.set_fractions(brick, ByteBrick{});
    v1::StateFrame frame = halve_a_voxel();
    *frame.mutable_edits(0) = brick_edit(brick, servers_.fractions(3), VoxelMask().set());
    const auto outcome = follower_.apply(frame, dirty_);
    ASSERT_TRUE(std::holds_alternative<BoneFollower::Applied>(outcome));
    EXPECT_TRUE(std::get<BoneFollower::Applied>(outcome).has_regained_bone);
    EXPECT_EQ(std::get<BoneFollower::Applied>(outcome).check, CopyCheck::equal);
}

TEST_F(BoneFollowerTest, RefusesWhatMakesNoSense) {
    auto frame = halve_a_voxel();
    frame.mutable_tool()->set_burr(1);
    EXPECT_TRUE(std::holds_alternative<WireError>(follower_.apply(frame, dirty_)));
    frame.mutable_tool()->set_burr(0);
    frame.mutable_edits(0)->set_brick(1'000'000);
    EXPECT_TRUE(std::holds_alternative<WireError>(follower_.apply(frame, dirty_)));
}

TEST_F(BoneFollowerTest, IsPutBackToWhatItWas) {
    const std::uint64_t before = follower_.checksum();
    const ByteBrick whole = [&] {
        ByteBrick brick;
        std::ranges::copy(servers_.fractions(3), brick.begin());
        return brick;
    }();
    ASSERT_TRUE(std::holds_alternative<BoneFollower::Applied>(follower_.apply(halve_a_voxel(), dirty_)));
    EXPECT_NE(follower_.checksum(), before);
    follower_.set_fractions(dirty_[0], whole);
    EXPECT_EQ(follower_.checksum(), before);
    EXPECT_EQ(checksum(follower_.bone()), before);
}

}  // namespace
}  // namespace osteomill
