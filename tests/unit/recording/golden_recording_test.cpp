// Recordings of earlier versions of the protocol: they stay readable. For each version there is one, made by
// the haptic_server of its time.
#include <gtest/gtest.h>

#include <limits>

#include "common/recording/playhead.h"

namespace osteomill {
namespace {

/// A block of bone with stiffness by CT number, drilled and milled with a 1.5 mm burr on the virtual clock.
/// What is expected is what that server's --json said.
TEST(GoldenRecording, OfProtocol1_1IsReadAsItsServerLeftIt) {
    Playhead playhead(std::filesystem::path(OSTEOMILL_TEST_DATA) / "recording_1_1.pcap");
    const double bone_before_mm3 = bone_volume_mm3(playhead.bone());
    EXPECT_EQ(playhead.session().scene_name, "block");
    EXPECT_EQ(playhead.session().server_version, "0.1.0");
    EXPECT_EQ(playhead.session().protocol_major, 1U);
    EXPECT_EQ(playhead.session().protocol_minor, 1U);
    EXPECT_EQ(playhead.bone().grid().size_voxels, glm::ivec3(48, 40, 32));
    EXPECT_EQ(playhead.bone().grid().spacing_mm, 0.2);
    EXPECT_FALSE(playhead.bone().content().stiffness.empty());

    bool has_goodbye = false;
    for (auto step = Playhead::Step::state; step != Playhead::Step::end;) {
        step = playhead.step(std::numeric_limits<double>::infinity());
        has_goodbye = has_goodbye || step == Playhead::Step::goodbye;
    }
    EXPECT_TRUE(has_goodbye);
    EXPECT_EQ(playhead.frames(), 95U);
    EXPECT_EQ(playhead.checksums_verified(), 4U);
    EXPECT_NEAR(playhead.time_s(), 2.805, 1e-6);
    EXPECT_EQ(checksum(playhead.bone()), 0x99c5f32e3e1bca0cU);
    EXPECT_NEAR(bone_before_mm3 - bone_volume_mm3(playhead.bone()), 3.723921568627453, 1e-9);
    EXPECT_EQ(playhead.session().burrs.at(playhead.tool()->burr).name, "1.5 mm");
}

}  // namespace
}  // namespace osteomill
