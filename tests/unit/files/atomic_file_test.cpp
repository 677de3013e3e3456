#include "common/files/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

namespace fs = std::filesystem;
using testing::FileSizeLimit;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;

std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::ptrdiff_t files_in(const TemporaryFolder& folder) {
    return std::distance(fs::directory_iterator(folder.path()), {});
}

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

TEST(AtomicFile, ReplacesTheOldFileOnlyWhenCommitted) {
    const TemporaryFolder folder;
    const fs::path path = folder / "bone.nrrd";
    write(path, "old");
    AtomicFile file(path);
    write(file.part(), "new");
    EXPECT_EQ(content(path), "old");
    file.commit();
    EXPECT_EQ(content(path), "new");
    EXPECT_FALSE(fs::exists(file.part()));
}

TEST(AtomicFile, LeavesTheOldFileAndNoPartWhereItIsGivenUp) {
    const TemporaryFolder folder;
    const fs::path path = folder / "bone.nrrd";
    write(path, "old");
    {
        const AtomicFile file(path);
        write(file.part(), "half of the n");
    }
    EXPECT_EQ(content(path), "old");
    EXPECT_EQ(files_in(folder), 1);
}

TEST(AtomicFile, KeepsAPartThatIsWorthSomething) {
    const TemporaryFolder folder;
    const fs::path path = folder / "session.pcap";
    fs::path part;
    {
        AtomicFile file(path);
        part = file.part();
        write(part, "torn");
        file.keep_part();
    }
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(content(part), "torn");
}

TEST(AtomicFile, SaysWhichFileCannotBeWritten) {
    const TemporaryFolder folder;
    const fs::path path = folder / "no_folder" / "bone.nrrd";
    EXPECT_THAT([&] { AtomicFile(path).commit(); },
                ThrowsMessage<std::runtime_error>(HasSubstr(path.string() + ": cannot be written: No such")));
    EXPECT_THAT([&] { write_atomic_file(path, "text"); },
                ThrowsMessage<std::runtime_error>(HasSubstr(path.string() + ": cannot be written: No such")));
}

TEST(AtomicFile, ReplacesWhatALinkPointsTo) {
    const TemporaryFolder folder;
    const fs::path real = folder / "real.json";
    const fs::path link = folder / "link.json";
    write(real, "old");
    fs::create_symlink("real.json", link);
    write_atomic_file(link, "new");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(content(real), "new");
}

TEST(AtomicFile, GoesThroughLinksToTheFileAtTheirEnd) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "disk");
    write(folder / "disk/real.json", "old");
    fs::create_symlink("disk/second.json", folder / "first.json");
    fs::create_symlink("real.json", folder / "disk/second.json");
    write_atomic_file(folder / "first.json", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "first.json") && fs::is_symlink(folder / "disk/second.json"));
    EXPECT_EQ(content(folder / "disk/real.json"), "new");
}

TEST(AtomicFile, IsRefusedAtALinkThatLeadsToNothing) {
    const TemporaryFolder folder;
    fs::create_symlink("second.json", folder / "first.json");
    fs::create_symlink("real.json", folder / "second.json");
    EXPECT_THAT([&] { write_atomic_file(folder / "first.json", "new"); },
                ThrowsMessage<std::runtime_error>(HasSubstr(
                    (folder / "first.json").string() + ": is a link to " + (folder / "real.json").string())));
    EXPECT_TRUE(fs::is_symlink(folder / "first.json") && fs::is_symlink(folder / "second.json"));
    EXPECT_FALSE(fs::exists(folder / "real.json"));
}

TEST(AtomicFile, IsWrittenThroughNoLinkInAFolderFromElsewhere) {
    const TemporaryFolder folder;
    const fs::path precious = folder / "precious.txt";
    write(precious, "precious");
    for (const char* name : {"placement.part.toml", "placement.toml"})
        fs::create_symlink("precious.txt", folder / name);
    write_atomic_file(folder / "placement.toml", "new", Link::replace);
    EXPECT_EQ(content(precious), "precious");
    EXPECT_FALSE(fs::is_symlink(folder / "placement.toml"));
    EXPECT_EQ(content(folder / "placement.toml"), "new");
    EXPECT_EQ(open_new(folder / "placement.part.toml"), -1);
    EXPECT_EQ(errno, EEXIST);
}

TEST(AtomicFile, HasAPartOfANameThatNobodyKnowsBefore) {
    const TemporaryFolder folder;
    const AtomicFile one(folder / "a.toml");
    const AtomicFile other(folder / "a.toml");
    EXPECT_NE(one.part(), other.part());
    EXPECT_EQ(one.part().extension(), ".toml");
    EXPECT_EQ(one.part().parent_path(), folder.path());
}

TEST(AtomicFile, LosesThePartsOfProgramsThatWereKilledAndNoOthers) {
    const TemporaryFolder folder;
    const AtomicFile being_written(folder / "bone.nrrd");
    for (const char* name : {"bone.part-0123abcd.nrrd", "bone.part-kept.nrrd", "other.part-0123abcd.nrrd",
                             "bone.part-0123abcd.json", "bone.nrrd"})
        write(folder / name, "x");
    fs::create_symlink("bone.nrrd", folder / "bone.part-00000000.nrrd");
    remove_abandoned_parts(folder / "bone.nrrd");
    EXPECT_FALSE(fs::exists(folder / "bone.part-0123abcd.nrrd"));
    EXPECT_TRUE(fs::exists(being_written.part())) << "another is at it";
    EXPECT_EQ(files_in(folder), 6) << "nothing else goes";
}

TEST(AtomicFile, WritesToADeviceWithoutReplacingIt) {
    write_atomic_file("/dev/null", "text");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, WritesToAPipeThatIsReadAndRefusesAnother) {
    const TemporaryFolder folder;
    const fs::path pipe = folder / "forces.csv";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT([&] { AtomicFile file(pipe); },
                ThrowsMessage<std::runtime_error>(HasSubstr("forces.csv: is a pipe that no program reads")));
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    write_atomic_file(pipe, "text");
    char read[8]{};
    EXPECT_EQ(::read(reader, read, sizeof read), 4);
    EXPECT_STREQ(read, "text");
    ::close(reader);
}

TEST(WriteAtomicFile, LeavesTheOldFileOnAFullDisk) {
    const TemporaryFolder folder;
    const fs::path path = folder / "measurements.json";
    write(path, "old");
    {
        const FileSizeLimit limit(1000);
        EXPECT_THAT([&] { write_atomic_file(path, std::string(5000, 'x')); },
                    ThrowsMessage<std::runtime_error>(HasSubstr("File too large")));
    }
    EXPECT_EQ(content(path), "old");
    EXPECT_EQ(files_in(folder), 1);
}

}  // namespace
}  // namespace osteomill
