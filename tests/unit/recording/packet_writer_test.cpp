#include <gmock/gmock.h>

#include "common/recording/pcap_file.h"
#include "common/wire/frame.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/made_recording.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const Stamp noon{std::chrono::seconds(1'800'000'000) + std::chrono::nanoseconds(123'456'789)};

std::string failure_of(const std::filesystem::path& file) {
    return testing::message_of<RecordingError>([&] { const PacketWriter writer(file); });
}

TEST(PacketWriter, WritesPcapWithNanosecondsAndLinkTypeUser0) {
    const testing::TemporaryFolder folder;
    PacketWriter writer(folder / "a.pcap");
    writer.write(noon, "hello");
    // https://www.tcpdump.org/manpages/pcap-savefile.5.html, on a little-endian machine
    const std::string bytes = testing::bytes_of(folder / "a.pcap");
    ASSERT_EQ(bytes.size(), 24U + 16U + 5U) << "at once, not when the file is closed";
    EXPECT_EQ(bytes.substr(0, 4), "\x4d\x3c\xb2\xa1");
    EXPECT_EQ(bytes[20], '\x93');
    EXPECT_EQ(bytes.substr(40), "hello");
    EXPECT_EQ(writer.bytes(), bytes.size());
    EXPECT_EQ(writer.packets(), 1U);
}

TEST(PacketWriter, IsReadAsItWasWritten) {
    const testing::TemporaryFolder folder;
    const std::string large(largest_frame_bytes, 'x');
    {
        PacketWriter writer(folder / "a.pcap");
        writer.write(noon, "one");
        writer.write(noon + std::chrono::nanoseconds(1), large);
        EXPECT_THROW(writer.write(noon, large + "x"), RecordingError);
    }
    PacketReader reader(folder / "a.pcap");
    const auto one = reader.next();
    ASSERT_TRUE(one);
    EXPECT_EQ(one->stamp, noon);
    EXPECT_EQ(std::string(one->message.begin(), one->message.end()), "one");
    const auto two = reader.next();
    ASSERT_TRUE(two);
    EXPECT_EQ(two->stamp, noon + std::chrono::nanoseconds(1));
    EXPECT_EQ(two->message.size(), large.size());
    EXPECT_EQ(two->place.number, 2U);
    EXPECT_EQ(two->place.offset_bytes, 24U + 16U + 3U);
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.is_truncated());
}

TEST(PacketWriter, SaysInOneLineWhyItCannotWrite) {
    EXPECT_THAT(failure_of("/nowhere/a.pcap"), AllOf(HasSubstr("/nowhere/a.pcap"), HasSubstr("No such")));
    EXPECT_THAT(failure_of("/dev/full"), HasSubstr("No space"));
}

TEST(PacketWriter, EndsWithTheLastWholePacketWhileTheDiskIsFullAndGoesOnBehindIt) {
    const testing::TemporaryFolder folder;
    PacketWriter writer(folder / "a.pcap");
    std::string error;
    {
        const testing::FileSizeLimit disk(10'000);
        try {
            for (int i = 0; i < 100; ++i) writer.write(noon, std::string(1000, 'x'));
        } catch (const RecordingError& failure) {
            error = failure.what();
        }
    }
    EXPECT_THAT(error, AllOf(HasSubstr("a.pcap"), HasSubstr("no more than 9 frames could be written: ")));
    EXPECT_EQ(std::filesystem::file_size(folder / "a.pcap"), 24U + 9 * 1016U);
    PacketReader reader(folder / "a.pcap");
    int packets = 0;
    while (reader.next()) ++packets;
    EXPECT_EQ(packets, 9);
    EXPECT_FALSE(reader.is_truncated());
    writer.write(noon, "there is room again");
    PacketReader again(folder / "a.pcap");
    std::string last;
    for (packets = 0; const auto packet = again.next(); ++packets)
        last = std::string(packet->message.begin(), packet->message.end());
    EXPECT_EQ(packets, 10);
    EXPECT_EQ(last, "there is room again");
}

}  // namespace
}  // namespace osteomill
