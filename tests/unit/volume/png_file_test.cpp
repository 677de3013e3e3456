#include "render_client/volume/png_file.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace osteomill::png_file_test {
namespace {

TEST(PngFile, ReadsBackWhatItWrote) {
    Picture picture({31, 17});
    for (std::size_t byte = 0; byte < picture.rgb.size(); ++byte)
        picture.rgb[byte] = static_cast<std::uint8_t>(byte * 37 + byte / 11);
    const auto file = std::filesystem::path(testing::TempDir()) / "png_file_test.png";
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

}  // namespace
}  // namespace osteomill::png_file_test
