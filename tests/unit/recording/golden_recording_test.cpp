// Recordings of other versions of the protocol: 2.0 had no ticks and is read; 1.x, which was never released,
// is refused in one line.
#include <gmock/gmock.h>

#include <limits>

#include "common/recording/playhead.h"

namespace osteomill {
namespace {

TEST(GoldenRecording, OfProtocol1IsRefusedInOneLineThatSaysSo) {
    try {
        Playhead playhead(std::filesystem::path(REPOSITORY "/tests/data") / "recording_1_1.pcap");
        FAIL() << "it was read";
    } catch (const RecordingError& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("recording_1_1.pcap, packet 1"));
        EXPECT_THAT(error.what(),
                    ::testing::HasSubstr(
                        "recorded with protocol 1, this program reads 2: use Osteomill 0.1.0 or earlier"));
    }
}

TEST(GoldenRecording, OfProtocol20HasNoTicksAndIsRead) {
    // haptic_server 0.2.0 of protocol 2.0, on tests/support/block_file.h's block: its own --json said so.
    Playhead playhead(std::filesystem::path(REPOSITORY "/tests/data") / "recording_2_0.pcap");
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end) {
        EXPECT_TRUE(playhead.ticks().empty());
    }
    EXPECT_FALSE(playhead.session().holds_ticks);
    EXPECT_EQ(playhead.counts().ticks, 0U);
    EXPECT_EQ(playhead.bone_checksum(), 0xaff1f42ae77592c5U);
    EXPECT_NEAR(playhead.tool()->removed_mm3, 0.11651764705882356, 1e-9);
}

}  // namespace
}  // namespace osteomill
