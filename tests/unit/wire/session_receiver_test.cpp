#include "common/wire/session_receiver.h"

#include <gmock/gmock.h>

#include "common/wire/scene_messages.h"
#include "tests/support/block.h"
#include "tests/support/packed.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

/// The frames of a session with a block of bone, numbered from 1.
class SessionReceiverTest : public ::testing::Test {
  protected:
    template <typename Event>
    void expect(const v2::ServerFrame& frame) {
        auto outcome = receiver_.take(frame);
        ASSERT_TRUE(std::holds_alternative<SessionEvent>(outcome)) << std::get<WireError>(outcome).line;
        EXPECT_TRUE(std::holds_alternative<Event>(std::get<SessionEvent>(outcome)));
    }
    void expect_refused(const v2::ServerFrame& frame, const std::string& why) {
        const auto outcome = receiver_.take(frame);
        ASSERT_TRUE(std::holds_alternative<WireError>(outcome));
        EXPECT_THAT(std::get<WireError>(outcome).line, HasSubstr(why));
    }
    v2::ServerFrame next() {
        v2::ServerFrame frame;
        frame.set_sequence(++sequence_);
        return frame;
    }
    v2::ServerFrame hello(std::uint32_t major = protocol_major) {
        auto frame = next();
        *frame.mutable_hello() = to_message(SessionInfo{.protocol_major = major, .burrs = {Burr{}}});
        return frame;
    }
    v2::ServerFrame state() {
        auto frame = next();
        frame.mutable_state();
        return frame;
    }
    void go_live() {
        expect<SessionInfo>(hello());
        auto begin = next();
        *begin.mutable_snapshot_begin() = snapshot_begin(bone_);
        expect<SnapshotGoesOn>(begin);
        EXPECT_EQ(receiver_.bricks_announced(), bone_.stored_bricks());
        auto bricks = next();
        SnapshotPacker packer;
        *bricks.mutable_snapshot_bricks() = packer.pack(bone_, 0);
        expect<SnapshotGoesOn>(bricks);
        EXPECT_EQ(receiver_.bricks_received(), bone_.stored_bricks());
        EXPECT_FALSE(receiver_.is_live());
        auto end = next();
        end.mutable_snapshot_end()->set_checksum(checksum(bone_));
        expect<BoneArrived>(end);
        EXPECT_TRUE(receiver_.is_live());
    }

    Bone bone_ = testing::make_block({0, 0, 0}, {2, 2, 2}, 0.1);
    SessionReceiver receiver_;
    std::uint64_t sequence_ = 0;
};

TEST_F(SessionReceiverTest, TakesASessionInItsOrder) {
    go_live();
    expect<StateArrived>(state());
    expect<StateArrived>(state());
    auto goodbye = next();
    goodbye.mutable_goodbye();
    expect<SaidGoodbye>(goodbye);
    expect_refused(state(), "is not what should come there");
}

TEST_F(SessionReceiverTest, SaysThatStatesAreMissingWhereTheyCanBeAskedFor) {
    receiver_ = SessionReceiver(Gaps::reported);
    go_live();
    ++sequence_;
    const auto outcome = receiver_.take(state());
    ASSERT_TRUE(std::holds_alternative<SessionEvent>(outcome));
    EXPECT_TRUE(std::get<StateArrived>(std::get<SessionEvent>(outcome)).follows_gap);
    expect<StateArrived>(state());
    sequence_ -= 2;
    expect_refused(state(), "frame 6 came after 7");
}

TEST_F(SessionReceiverTest, RefusesAGapBeforeTheBoneIsComplete) {
    receiver_ = SessionReceiver(Gaps::reported);
    expect<SessionInfo>(hello());
    ++sequence_;
    expect_refused(state(), "frame 3 came after 1");
}

TEST_F(SessionReceiverTest, RefusesAStateThatMakesNoSense) {
    go_live();
    auto frame = state();
    frame.mutable_state()->mutable_tool()->set_burr(1);
    expect_refused(frame, "burr 1 is not one of the scene's 1");
    receiver_ = {};
    sequence_ = 0;
    go_live();
    frame = state();
    *frame.mutable_state()->mutable_changes() = testing::packed({{.change = {.brick = 1'000'000}}});
    expect_refused(frame, "brick 1000000 lies outside the grid");
}

TEST_F(SessionReceiverTest, RefusesWhatComesOutOfOrder) {
    expect_refused(state(), "frame 1 is not what should come there");
    receiver_ = {};
    expect<SessionInfo>(hello());
    expect_refused(state(), "frame 3 is not what should come there");
    receiver_ = {};
    sequence_ = 0;
    go_live();
    ++sequence_;
    expect_refused(state(), "frame 6 came after 4");
}

TEST_F(SessionReceiverTest, UnderstandsNothingOfAnotherMajorVersion) {
    expect<SpeaksOtherProtocol>(hello(protocol_major + 1));
    expect_refused(state(), "is not what should come there");
}

TEST_F(SessionReceiverTest, GoesOnBehindAnEarlierFrame) {
    go_live();
    for (int i = 0; i < 5; ++i) expect<StateArrived>(state());
    sequence_ = 6;
    receiver_.go_on_behind(sequence_);
    expect<StateArrived>(state());
    EXPECT_EQ(receiver_.last_sequence(), 7U);
}

}  // namespace
}  // namespace osteomill
