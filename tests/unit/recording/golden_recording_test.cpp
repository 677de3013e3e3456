// Recordings of other versions of the protocol: those of 1.x, which was never released, are refused in one
// line.
#include <gmock/gmock.h>

#include "common/recording/playhead.h"

namespace osteomill {
namespace {

TEST(GoldenRecording, OfProtocol1IsRefusedInOneLineThatSaysSo) {
    try {
        Playhead playhead(std::filesystem::path(OSTEOMILL_TEST_DATA) / "recording_1_1.pcap");
        FAIL() << "it was read";
    } catch (const RecordingError& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("recording_1_1.pcap, packet 1"));
        EXPECT_THAT(error.what(), ::testing::HasSubstr("recorded with protocol 1, this program reads 2"));
    }
}

}  // namespace
}  // namespace osteomill
