// The state of the cut joins the tool's state in the streaming server, behind the haptic loop.
#include <gtest/gtest.h>

#include "haptic_server/streaming/live_session.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

TEST(LiveCut, IsToldWhileTheSpindleTurns) {
    const Bone bone = testing::make_block({0, 0, 0}, {1, 1, 1}, 0.1);
    BoneReplica mirror(bone);
    TripleBuffer<ToolState> tool;
    TripleBuffer<std::optional<CutState>> cuts;
    ChangeQueue changes(1 << 10, bone.shared_content());
    LiveSession session(tool, changes);
    const auto told = [&](bool spindle_on) {
        tool.back() = {.spindle_on = spindle_on};
        tool.publish();
        return session.update(mirror, 0).tool.cut;
    };
    EXPECT_FALSE(told(true)) << "it does not listen yet";
    session.listen_to(cuts);
    EXPECT_FALSE(told(true));
    cuts.back() = CutState{.force_n = 0.5};
    cuts.publish();
    EXPECT_EQ(told(true), CutState{.force_n = 0.5});
    EXPECT_FALSE(told(false)) << "the milling loop may have stopped with its last cut still there";
    cuts.back() = std::nullopt;
    cuts.publish();
    EXPECT_FALSE(told(true));
}

}  // namespace
}  // namespace osteomill
