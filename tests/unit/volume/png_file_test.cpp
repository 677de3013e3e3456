#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "render_client/volume/picture.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::png_file_test {
namespace {

TEST(PngFile, ReadsBackWhatItWrote) {
    Picture picture({31, 17});
    for (std::size_t byte = 0; byte < picture.rgb.size(); ++byte)
        picture.rgb[byte] = static_cast<std::uint8_t>(byte * 37 + byte / 11);
    const auto file = std::filesystem::path(::testing::TempDir()) / "png_file_test.png";
    write_png(picture, file);
    EXPECT_EQ(read_png(file), picture);
    std::filesystem::remove(file);
}

TEST(PngFile, NamesTheFileThatItCannotWrite) {
    try {
        write_png(Picture({1, 1}), "/no/such/folder/picture.png");
        FAIL() << "wrote into a folder that is not there";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("/no/such/folder/picture.png"), std::string::npos);
    }
}

TEST(PngFile, SaysWhyItCannotBeWrittenAndLeavesTheOldOne) {
    const osteomill::testing::TemporaryFolder folder;
    const auto file = folder / "picture.png";
    write_png(Picture({1, 1}), file);
    Picture large({100, 100});
    for (std::size_t byte = 0; byte < large.rgb.size(); ++byte)
        large.rgb[byte] = static_cast<std::uint8_t>(byte * byte / 7);
    try {
        const osteomill::testing::FileSizeLimit disk(1000);
        write_png(large, file);
        FAIL() << "wrote on a full disk";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "cannot write the picture " + file.string() + ": File too large");
    }
    EXPECT_EQ(read_png(file), Picture({1, 1}));
    std::filesystem::remove(file);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace osteomill::png_file_test
