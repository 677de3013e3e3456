#include "common/files/session_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::text_of;
using ::testing::ThrowsMessage;

void put(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

TEST(SessionFile, LeavesTheOldFileUntilItsSessionEnds) {
    const TemporaryFolder folder;
    put(folder / "a.pcap", "old");
    SessionFile file(folder / "a.pcap");
    EXPECT_EQ(file.torn(), std::nullopt);
    put(file.part(), "new");
    EXPECT_EQ(text_of(folder / "a.pcap"), "old");
    file.commit();
    EXPECT_EQ(text_of(folder / "a.pcap"), "new");
    EXPECT_FALSE(fs::exists(folder / "a.part.pcap"));
}

TEST(SessionFile, LeavesNothingWhereItsSessionDoesNotBegin) {
    const TemporaryFolder folder;
    { const SessionFile file(folder / "a.pcap"); }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SessionFile, MovesThePartsOfKilledSessionsAside) {
    const TemporaryFolder folder;
    for (const std::string session : {"first", "second"}) {
        SessionFile file(folder / "a.pcap");
        put(file.part(), session);
        file.keep_part();
    }
    const SessionFile file(folder / "a.pcap");
    EXPECT_EQ(file.torn(), folder / "a.torn-2.pcap");
    EXPECT_EQ(text_of(folder / "a.torn-1.pcap"), "first");
    EXPECT_EQ(text_of(folder / "a.torn-2.pcap"), "second");
    EXPECT_EQ(text_of(file.part()), "");
}

TEST(SessionFile, IsRefusedToASecondSessionWhileTheFirstWritesIt) {
    const TemporaryFolder folder;
    SessionFile first(folder / "a.pcap");
    put(first.part(), "first");
    EXPECT_THAT([&] { SessionFile(folder / "a.pcap"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("another session is writing it")));
    EXPECT_EQ(text_of(first.part()), "first");
    first.commit();
    EXPECT_EQ(text_of(folder / "a.pcap"), "first");
}

TEST(SessionFile, KeepsThePartBesideWhatALinkPointsTo) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "disk");
    put(folder / "disk" / "real.csv", "old");
    fs::create_symlink("disk/real.csv", folder / "link.csv");
    {
        SessionFile killed(folder / "link.csv");
        EXPECT_EQ(killed.part(), folder / "disk" / "real.part.csv");
        killed.keep_part();
    }
    SessionFile file(folder / "link.csv");
    EXPECT_TRUE(fs::exists(folder / "disk" / "real.torn-1.csv"));
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
    EXPECT_EQ(text_of(folder / "link.csv"), "");
}

TEST(SessionFile, MovesWhateverBearsItsPartsNameAside) {
    const TemporaryFolder folder;
    put(folder / "precious.txt", "precious");
    fs::create_symlink("precious.txt", folder / "a.part.pcap");
    ASSERT_EQ(::mkfifo((folder / "b.part.pcap").c_str(), 0600), 0);
    for (const char* name : {"a.pcap", "b.pcap"}) {
        SessionFile file(folder / name);
        put(file.part(), "new");
        file.commit();
        EXPECT_EQ(text_of(folder / name), "new");
    }
    EXPECT_EQ(text_of(folder / "precious.txt"), "precious");
}

TEST(SessionFile, WritesToADeviceDirectly) {
    SessionFile file("/dev/null");
    EXPECT_EQ(file.part(), "/dev/null");
    file.commit();
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(SessionFile, SaysWhichFileCannotBeWritten) {
    EXPECT_THAT(
        [] { SessionFile("/nowhere/a.pcap"); },
        ThrowsMessage<std::runtime_error>("/nowhere/a.pcap: cannot be written: No such file or directory"));
}

}  // namespace
}  // namespace osteomill
