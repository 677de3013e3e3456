#include <gmock/gmock.h>

#include "common/recording/pcap_file.h"
#include "tests/support/made_recording.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::size_t file_header_bytes = 24;
constexpr std::size_t packet_header_bytes = 16;

class PacketReaderTest : public ::testing::Test {
  protected:
    PacketReaderTest() {
        PacketWriter writer(file_);
        writer.write(Stamp{}, "first");
        writer.write(Stamp{}, "second");
        good_ = testing::bytes_of(file_);
    }
    /// The message on these bytes as a file; empty if all packets can be read.
    std::string complaint(const std::string& bytes) const {
        testing::write_bytes(file_, bytes);
        return testing::message_of<RecordingError>([&] {
            PacketReader reader(file_);
            while (reader.next()) {
            }
        });
    }
    /// The good file with a 32-bit number put somewhere.
    std::string with(std::size_t offset, std::uint32_t number) const {
        std::string bytes = good_;
        for (int i = 0; i < 4; ++i) bytes[offset++] = static_cast<char>(number >> (8 * i));
        return bytes;
    }

    testing::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.pcap";
    std::string good_;
};

TEST_F(PacketReaderTest, TakesAFileTornAnywhereForWhatIsWholeOfIt) {
    const std::size_t second = file_header_bytes + packet_header_bytes + 5;
    for (std::size_t size = second; size <= good_.size(); ++size) {
        testing::write_bytes(file_, good_.substr(0, size));
        PacketReader reader(file_);
        int packets = 0;
        while (reader.next()) ++packets;
        EXPECT_EQ(packets, size == good_.size() ? 2 : 1) << size;
        EXPECT_EQ(reader.is_truncated(), size != second && size != good_.size()) << size;
    }
}

TEST_F(PacketReaderTest, GoesBackToAPlace) {
    PacketReader reader(file_);
    reader.next();
    const PacketPlace second = reader.place();
    while (reader.next()) {
    }
    reader.seek(second);
    const auto packet = reader.next();
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->place.number, 2U);
    EXPECT_EQ(packet->message.size(), 6U);
    EXPECT_FALSE(reader.next());
}

TEST_F(PacketReaderTest, RefusesInOneLineWhatIsNoRecording) {
    EXPECT_EQ(complaint(good_), "");
    EXPECT_THAT(complaint("no capture at all, but text"), AllOf(HasSubstr("a.pcap"), HasSubstr("pcap file")));
    EXPECT_THAT(complaint(""), HasSubstr("pcap file"));
    EXPECT_THAT(complaint(with(20, 1)), AllOf(HasSubstr("link type 1,"), HasSubstr("147")));
    EXPECT_THROW(PacketReader("/nowhere/a.pcap"), RecordingError);
    EXPECT_THROW(PacketReader(folder_.path()), RecordingError);
}

TEST_F(PacketReaderTest, RefusesPacketsThatCannotBeWithTheirPlace) {
    const std::size_t kept = file_header_bytes + 8;
    EXPECT_THAT(complaint(with(kept, 4)), AllOf(HasSubstr("packet 1 at byte 24: "), HasSubstr("only 4 of")));
    EXPECT_THAT(complaint(with(kept, 0xFFFFFFFF)), HasSubstr("packet 1 at byte 24: "));
    EXPECT_THAT(complaint(with(file_header_bytes + 4, 0xFFFFFFFF)), HasSubstr("time stamp"));
    std::string empty = with(kept, 0);
    empty.replace(kept + 4, 4, std::string(4, '\0'));
    EXPECT_THAT(complaint(empty), HasSubstr("it has 0 bytes"));
}

}  // namespace
}  // namespace osteomill
