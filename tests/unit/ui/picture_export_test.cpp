#include "render_client/ui/view/picture_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "render_client/volume/picture.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::picture_export_test {
namespace {

Picture grey(std::uint8_t value) {
    Picture picture({4, 3});
    std::fill(picture.rgb.begin(), picture.rgb.end(), value);
    return picture;
}

TEST(PictureExport, WritesScreenshotsAndNeverOverOne) {
    const osteomill::testing::TemporaryFolder folder;
    const auto first = PictureExport(folder / "new").write(grey(10));
    const auto second = PictureExport(folder / "new").write(grey(20));
    EXPECT_EQ(first.filename(), "screenshot_0001.png");
    EXPECT_EQ(second.filename(), "screenshot_0002.png");
    EXPECT_EQ(read_png(first), grey(10));
    EXPECT_EQ(read_png(second), grey(20));
}

TEST(PictureExport, ListsFramesWithTheirTimes) {
    const osteomill::testing::TemporaryFolder folder;
    PictureExport pictures(folder / "");
    EXPECT_FALSE(pictures.is_exporting());
    const auto frames = pictures.begin_frames();
    pictures.add_frame(grey(1), 7.0);
    pictures.add_frame(grey(2), 7.04);
    pictures.end_frames();
    pictures.add_frame(grey(3), 8.0);  // after the end: not written
    std::stringstream list;
    list << std::ifstream(frames / "frames.ffconcat").rdbuf();
    EXPECT_EQ(list.str(),
              "ffconcat version 1.0\nfile frame_000001.png\nduration 0.0400\nfile frame_000002.png\n");
    EXPECT_EQ(read_png(frames / "frame_000002.png"), grey(2));
    EXPECT_FALSE(std::filesystem::exists(frames / "frame_000003.png"));
}

TEST(PictureExport, SaysWhichFolderItCannotWriteTo) {
    const osteomill::testing::TemporaryFolder folder;
    std::ofstream(folder / "file") << "in the way";
    try {
        PictureExport(folder / "file").write(grey(1));
        FAIL() << "a file is no folder";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr((folder / "file").string()));
    }
}

}  // namespace
}  // namespace osteomill::picture_export_test
