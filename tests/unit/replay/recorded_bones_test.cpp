#include <gmock/gmock.h>

#include <stdexcept>

#include "common/recording/playhead.h"
#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::MadeRecording;

TEST(RecordedBones, AreTheBoneBeforeAndAfter) {
    const testing::TemporaryFolder folder;
    const MadeRecording made = testing::make_recording(folder / "a.pcap");
    const RecordedBones bones = bones_of(folder / "a.pcap", [](double) {});
    EXPECT_EQ(checksum(bones.at_start), checksum(made.before));
    EXPECT_EQ(checksum(bones.at_end), checksum(made.after));
    EXPECT_EQ(bones.error, "");
}

TEST(RecordedBones, AreOfTheLastSessionOfAJoinedRecording) {
    const testing::TemporaryFolder folder;
    testing::make_recording(folder / "a.pcap", {.states = 20});
    const MadeRecording last = testing::make_recording(folder / "b.pcap", {.states = 30, .seed = 9});
    testing::join(folder / "a.pcap", folder / "b.pcap", folder / "both.pcap");
    const RecordedBones bones = bones_of(folder / "both.pcap", [](double) {});
    EXPECT_EQ(checksum(bones.at_start), checksum(last.before));
    EXPECT_EQ(checksum(bones.at_end), checksum(last.after));
}

TEST(RecordedBones, HoldWhatCameBeforeWhatCannotBeRead) {
    const testing::TemporaryFolder folder;
    const MadeRecording made = testing::make_recording(folder / "a.pcap");
    testing::spoil(folder / "a.pcap", 19);
    const RecordedBones bones = bones_of(folder / "a.pcap", [](double) {});
    EXPECT_THAT(bones.error, ::testing::HasSubstr("a.pcap, packet "));
    EXPECT_EQ(checksum(bones.at_end), made.checksum_after_state[180]);
    EXPECT_THROW(bones_of(folder / "a.pcap", [](double) { throw std::runtime_error("stop"); }),
                 std::runtime_error);
}

}  // namespace
}  // namespace osteomill
