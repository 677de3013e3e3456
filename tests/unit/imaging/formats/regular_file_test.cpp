#include "haptic_server/imaging/formats/regular_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "haptic_server/imaging/imaging_error.h"
#include "tests/support/raw_images.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::regular_file_test {
namespace {

std::string refusal(const std::filesystem::path& path) {
    try {
        const RegularFile file(path);
    } catch (const ImagingError& error) {
        return error.what();
    }
    return "opened";
}

TEST(RegularFile, ReadsFromAnyOffsetAndStopsAtTheEnd) {
    testing::TemporaryFolder folder;
    testing::write_bytes(folder / "x", "abcdef");
    const RegularFile file(folder / "x");
    EXPECT_EQ(file.size(), 6u);
    std::vector<std::byte> bytes(4);
    EXPECT_EQ(file.read_at(1, bytes), 4u);
    EXPECT_EQ(bytes.front(), std::byte{'b'});
    EXPECT_EQ(file.read_at(4, bytes), 2u);
    EXPECT_EQ(file.read_at(9, bytes), 0u);
    EXPECT_EQ(file.first_bytes(3).size(), 3u);
    EXPECT_EQ(file.first_bytes(~std::uint64_t{0}).size(), 6u);
}

TEST(RegularFile, StaysTheOneThatWasOpened) {
    testing::TemporaryFolder folder;
    testing::write_bytes(folder / "x", "old");
    const RegularFile file(folder / "x");
    testing::write_bytes(folder / "new", "new");
    std::filesystem::rename(folder / "new", folder / "x");
    EXPECT_EQ(file.first_bytes(3), (std::vector<std::uint8_t>{'o', 'l', 'd'}));
}

TEST(RegularFile, OpensNeitherPipesNorDevicesNorFolders) {
    testing::TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const std::filesystem::path& path :
         {folder / "pipe", std::filesystem::path("/dev/zero"), folder.path()})
        EXPECT_THAT(refusal(path), ::testing::HasSubstr("it is a folder, a pipe or a device")) << path;
    EXPECT_THAT(refusal(folder / "none"), ::testing::HasSubstr("No such file"));
    std::filesystem::create_symlink("loop", folder / "loop");
    EXPECT_THAT(refusal(folder / "loop"), ::testing::HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace osteomill::regular_file_test
