#include "common/recording/recording_writer.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>

#include "common/recording/pcap_file.h"
#include "tests/support/eventually.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unread_pipe.h"

namespace osteomill {
namespace {

TEST(RecordingWriter, WritesAllThatWasPushedInOrder) {
    const testing::TemporaryFolder folder;
    RecordingWriter writer(folder / "a.pcap", {}, WhenDiskIsFull::end);
    for (int i = 0; i < 1000; ++i) writer.push(Stamp{std::chrono::milliseconds(i)}, std::to_string(i));
    writer.commit();
    writer.push(Stamp{}, "too late");
    EXPECT_EQ(writer.report().frames, 1000U);
    EXPECT_EQ(writer.report().error, "");
    PacketReader reader(folder / "a.pcap");
    for (int i = 0; i < 1000; ++i) {
        const auto packet = reader.next();
        ASSERT_TRUE(packet);
        ASSERT_EQ(std::string(packet->message.begin(), packet->message.end()), std::to_string(i));
    }
    EXPECT_FALSE(reader.next());
}

TEST(RecordingWriter, SaysOnceThatTheDiskIsFullAndGoesOnWithoutIt) {
    const testing::TemporaryFolder folder;
    std::vector<std::string> lines;
    RecordingWriter writer(
        folder / "a.pcap", [&](RecordingNews, const std::string& line) { lines.push_back(line); },
        WhenDiskIsFull::end);
    {
        const testing::FileSizeLimit disk(5'000);
        for (int i = 0; i < 20; ++i) {
            writer.wait_for_room();
            writer.push(Stamp{}, std::string(1000, 'x'));
        }
        writer.wait_until_written();
    }
    EXPECT_TRUE(writer.has_failed());
    EXPECT_TRUE(writer.has_room());
    writer.push(Stamp{}, "forgotten");
    writer.finish();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(writer.report().error, lines[0]);
    EXPECT_EQ(writer.report().frames, 4U);
}

TEST(RecordingWriter, GoesOnWithoutAGapWhenADiskThatWasFullHasRoom) {
    const testing::TemporaryFolder folder;
    std::vector<RecordingNews> news;
    RecordingWriter writer(
        folder / "a.pcap", [&](RecordingNews what, const std::string&) { news.push_back(what); },
        WhenDiskIsFull::try_again);
    const auto frame = [](int i) { return std::string(1000, static_cast<char>('a' + i)); };
    {
        const testing::FileSizeLimit disk(5'000);
        for (int i = 0; i < 10; ++i) writer.push(Stamp{}, frame(i));
        writer.wait_until_written();
        EXPECT_TRUE(writer.has_failed());
        EXPECT_THAT(writer.report().error, ::testing::HasSubstr("no more than 4 frames"));
        EXPECT_EQ(writer.report().frames, 4U);
        writer.push(Stamp{}, frame(10));
        EXPECT_TRUE(writer.has_room()) << "some may wait";
    }
    ASSERT_TRUE(testing::eventually([&] { return writer.report().frames == 11; }));
    writer.commit();
    EXPECT_EQ(writer.report().error, "");
    EXPECT_EQ(writer.report().pauses, 1U);
    EXPECT_THAT(news, ::testing::ElementsAre(RecordingNews::stands_still, RecordingNews::goes_on));
    PacketReader reader(folder / "a.pcap");
    for (int i = 0; i < 11; ++i) {
        const auto packet = reader.next();
        ASSERT_TRUE(packet) << i;
        ASSERT_EQ(std::string(packet->message.begin(), packet->message.end()), frame(i));
    }
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.is_truncated());
}

TEST(RecordingWriter, TriesOnceMoreWhenItIsClosedAndThenSaysWhatIsMissing) {
    const testing::TemporaryFolder folder;
    RecordingWriter writer(folder / "a.pcap", {}, WhenDiskIsFull::try_again);
    const testing::FileSizeLimit disk(5'000);
    for (int i = 0; i < 10; ++i) writer.push(Stamp{}, std::string(1000, 'x'));
    writer.finish();
    EXPECT_EQ(writer.report().frames, 4U);
    EXPECT_THAT(writer.report().error, ::testing::HasSubstr("no more than 4 frames"));
    EXPECT_EQ(writer.report().pauses, 0U);
}

TEST(RecordingWriter, LeavesTheOldRecordingUntilTheNewOneIsWhole) {
    const testing::TemporaryFolder folder;
    const auto path = folder / "a.pcap";
    const auto first_packet = [](const std::filesystem::path& file) {
        PacketReader reader(file);
        const auto packet = reader.next();
        return packet ? std::string(packet->message.begin(), packet->message.end()) : std::string();
    };
    const auto record = [&](const std::string& frame) {
        auto writer = std::make_unique<RecordingWriter>(path, RecordingWriter::OnNews(), WhenDiskIsFull::end);
        writer->push(Stamp{}, frame);
        writer->wait_until_written();
        return writer;
    };
    record("old")->commit();
    {
        const auto torn = record("torn");
        EXPECT_EQ(torn->report().file, folder / "a.part.pcap");
        EXPECT_EQ(first_packet(path), "old");
        EXPECT_EQ(first_packet(folder / "a.part.pcap"), "torn") << "while it is written";
    }
    EXPECT_EQ(first_packet(path), "old");
    const auto whole = record("new");
    EXPECT_EQ(whole->torn(), folder / "a.torn-1.pcap");
    EXPECT_EQ(first_packet(folder / "a.torn-1.pcap"), "torn");
    whole->commit();
    EXPECT_EQ(whole->report().file, path);
    EXPECT_EQ(first_packet(path), "new");

    record("nothing worth keeping")->discard();
    EXPECT_EQ(first_packet(path), "new");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.part.pcap"));
}

TEST(RecordingWriter, StaysAPartWhereFramesAreMissing) {
    const testing::TemporaryFolder folder;
    RecordingWriter writer(folder / "a.pcap", {}, WhenDiskIsFull::end);
    const testing::FileSizeLimit disk(5'000);
    for (int i = 0; i < 10; ++i) writer.push(Stamp{}, std::string(1000, 'x'));
    writer.commit();
    EXPECT_EQ(writer.report().file, folder / "a.part.pcap");
    EXPECT_THAT(writer.report().error, ::testing::HasSubstr("a.part.pcap: no more than 4 frames"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.pcap"));
}

TEST(RecordingWriter, SaysWhereTheFramesLieIfTheFileCannotHaveItsName) {
    const testing::TemporaryFolder folder;
    RecordingWriter writer(folder / "a.pcap", {}, WhenDiskIsFull::try_again);
    writer.push(Stamp{}, "kept");
    std::filesystem::create_directory(folder / "a.pcap");
    writer.commit();
    const auto part = folder / "a.part.pcap";
    EXPECT_EQ(writer.report().file, part);
    EXPECT_EQ(ending_of(writer.report()), (folder / "a.pcap").string() +
                                              ": cannot be written: Is a directory; what there is lies in " +
                                              part.string() + ", which packet_replay reads");
    EXPECT_EQ(PacketReader(part).next()->message.size(), 4U);
}

TEST(RecordingWriter, NeverWaitsForASlowDiskAndHoldsNoMoreThanItMay) {
    const testing::TemporaryFolder folder;
    const auto pipe = folder / "pipe";  // nobody reads it: the slowest disk there is
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    {
        RecordingWriter writer(pipe, {}, WhenDiskIsFull::try_again);
        const std::string frame(100'000, 'x');
        std::size_t pushed = 0;
        while (writer.has_room()) {
            writer.push(Stamp{}, frame);
            pushed += frame.size();
        }
        EXPECT_GE(pushed, RecordingWriter::capacity_bytes);
        EXPECT_LE(pushed, RecordingWriter::capacity_bytes + 5 * frame.size()) << "some are in the pipe";
        std::thread draining([&] {
            std::array<char, 65536> bytes;
            while (writer.report().frames < pushed / frame.size())
                [[maybe_unused]] const auto ignored = ::read(reader, bytes.data(), bytes.size());
        });
        writer.wait_for_room();
        writer.finish();
        draining.join();
        EXPECT_EQ(writer.report().error, "");
    }
    ::close(reader);
}

TEST(RecordingWriter, GivesUpAtTheEndOnADiskThatDoesNotAnswer) {
    const testing::TemporaryFolder folder;
    const auto pipe = folder / "pipe";
    const testing::UnreadPipe disk(pipe);
    RecordingWriter writer(pipe, {}, WhenDiskIsFull::try_again);
    while (writer.has_room()) writer.push(Stamp{}, std::string(100'000, 'x'));
    writer.wait_for_room(RecordingWriter::longest_standstill);
    EXPECT_TRUE(writer.has_room()) << "for what is forgotten";
    writer.commit();
    EXPECT_EQ(writer.report().frames, 0U);
    EXPECT_EQ(writer.report().error, pipe.string() + ": the disk does not answer; the recording ends there");
}

TEST(RecordingWriter, GivesUpOnADiskThatDoesNotTakeTheFirstFrame) {
    const testing::TemporaryFolder folder;
    const auto pipe = folder / "pipe";
    const testing::UnreadPipe disk(pipe);
    RecordingWriter writer(pipe, {}, WhenDiskIsFull::try_again);
    writer.push(Stamp{}, std::string(100'000, 'x'));
    writer.wait_until_written(std::chrono::milliseconds(200));
    EXPECT_TRUE(writer.has_failed());
    EXPECT_THAT(writer.report().error, ::testing::HasSubstr("the disk does not answer"));
}

}  // namespace
}  // namespace osteomill
