#include "haptic_server/session/save_and_finish.h"

#include <gtest/gtest.h>

#include "haptic_server/streaming/control_runner.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

TEST(SaveAndFinish, SaysForAsLongAsItIsSoThatNothingIsRecorded) {
    SaveAndFinish keeper({});
    SessionGate gate;
    const Bone bone = testing::make_block({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, 0.5);
    ChangeQueue restored(1 << 10, bone.shared_content());
    TripleBuffer<Placement> placements;
    const ControlRunner controls(gate, restored, placements, keeper.requests());
    EXPECT_EQ(controls.status().recording_problem, "");
    keeper.hear(RecordingNews::stands_still, "a.pcap: No space left on device");
    for (int frame = 0; frame < 2; ++frame)
        EXPECT_EQ(controls.status().recording_problem, "a.pcap: No space left on device");
    keeper.hear(RecordingNews::goes_on, "a.pcap: the recording goes on");
    EXPECT_EQ(controls.status().recording_problem, "");
}

}  // namespace
}  // namespace osteomill
