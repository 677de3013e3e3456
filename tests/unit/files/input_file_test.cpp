#include "common/files/input_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::TemporaryFolder;

constexpr InputKind small_kind{"a small file", 10};

template <typename Read>
std::string failure_of(const Read& read) {
    return testing::message_of<std::runtime_error>([&] { read(); });
}

TEST(InputFile, IsReadAsItIs) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a") << std::string("a\0b\n", 4);
    fs::create_symlink("a", folder / "link");
    EXPECT_EQ(read_text(folder / "a", small_kind), std::string("a\0b\n", 4));
    EXPECT_EQ(read_text(folder / "link", small_kind), std::string("a\0b\n", 4));
}

TEST(InputFile, IsNoPipeNoDeviceAndNoFolder) {
    const TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder / "link");
    for (const fs::path& path : {pipe, fs::path("/dev/zero"), folder / "link", folder.path()})
        EXPECT_EQ(failure_of([&] { read_text(path, small_kind); }),
                  path.string() +
                      ": cannot be read: it is a folder, a pipe or a device; it should be a small file");
    EXPECT_THAT(failure_of([&] { read_text(folder / "none", small_kind); }),
                HasSubstr("none: cannot be read: No such file or directory; it should be a small file"));
}

TEST(InputFile, HasNoMoreBytesThanItsKindAllows) {
    const TemporaryFolder folder;
    std::ofstream(folder / "sparse") << "x";
    EXPECT_EQ(read_text(folder / "sparse", small_kind), "x");
    fs::resize_file(folder / "sparse", std::uintmax_t{1} << 40U);
    EXPECT_THAT(failure_of([&] { read_text(folder / "sparse", small_kind); }),
                HasSubstr("has 1099511627776 bytes, more than the 10 that are read"));
}

TEST(InputFile, IsNamedOnOneLine) {
    EXPECT_THAT(failure_of([] { read_text("/no\nwhere\x1b[2J", small_kind); }),
                StartsWith("/no\\x0awhere\\x1b[2J: cannot be read"));
}

TEST(Secret, IsItsOwnersAlone) {
    using fs::perms;
    const TemporaryFolder folder;
    const fs::path key = folder / "a.key";
    std::ofstream(key) << "a key";
    const auto failure_at = [&](perms mode) {
        fs::permissions(key, mode);
        return failure_of([&] { EXPECT_EQ(read_secret(key, {"a key", 100}), "a key"); });
    };
    const perms owner = perms::owner_read | perms::owner_write;
    EXPECT_EQ(failure_at(owner), "");
    EXPECT_EQ(failure_at(perms::owner_read), "");
    EXPECT_THAT(failure_at(owner | perms::others_read),
                HasSubstr("is a key that others may read (its mode is 604)"));
    EXPECT_THAT(failure_at(owner | perms::others_write), HasSubstr("(its mode is 602)"));
    EXPECT_THAT(failure_at(owner | perms::group_write), HasSubstr("chmod 600 " + key.string()));
    // A group's key is fine in a place of root's.
    EXPECT_EQ(failure_at(owner | perms::group_read).empty(), ::geteuid() == 0);
    EXPECT_THAT(failure_of([&] { read_secret(folder / "none", small_kind); }), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace osteomill
