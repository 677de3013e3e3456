#include "render_client/ui/offscreen_run.h"

#include <filesystem>

#include "render_client/volume/png_file.h"
#include "tests/unit/ui/scripted_session.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::offscreen_run_test {
namespace {

class OffscreenRunTest : public testing::Test {
  protected:
    void SetUp() override {
        try {
            const gl::OffscreenContext context;
        } catch (const gl::NoOpenGl& error) {
            GTEST_SKIP() << "needs OpenGL without a display: " << error.what();
        }
        folder_ = std::filesystem::path(testing::TempDir()) /
                  testing::UnitTest::GetInstance()->current_test_info()->name();
        std::filesystem::remove_all(folder_);
        options_.offscreen = true;
        options_.screenshots = folder_;
        options_.window_size_px = glm::ivec2(200, 150);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
    RenderOptions options_;
};

bool never() {
    return false;
}

TEST_F(OffscreenRunTest, EndsAfterItsFramesAndWritesEveryKthAndTheLast) {
    options_.frames = 5;
    options_.screenshot_every = 2;
    ScriptedSession session(100);
    const RenderReport report = run_offscreen(options_, session, never);
    EXPECT_EQ(report.frame_times.count(), 5u);
    EXPECT_EQ(report.bone_checksum, checksum(*session.bone()));
    for (const char* name : {"frame_0002.png", "frame_0004.png", "final.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "frame_0003.png"));
    EXPECT_EQ(read_png(folder_ / "final.png").size_px, glm::ivec2(200, 150));
}

TEST_F(OffscreenRunTest, EndsWithTheSessionAndDrawsItsLastState) {
    options_.frames = 1000;
    ScriptedSession session(4);
    const RenderReport report = run_offscreen(options_, session, never);
    EXPECT_EQ(report.frame_times.count(), 4u);
    EXPECT_EQ(report.link_status, "session finished");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "final.png"));
}

TEST_F(OffscreenRunTest, StopsWhenAskedTo) {
    options_.frames = 1000;
    ScriptedSession session(1000);
    int polls = 0;
    const RenderReport report = run_offscreen(options_, session, [&] { return ++polls > 3; });
    EXPECT_LT(report.frame_times.count(), 5u);
}

TEST(ScreenshotInterval, SpreadsAboutThirtyOverTheFrames) {
    RenderOptions options;
    options.frames = 10;
    EXPECT_EQ(screenshot_interval(options), 1);
    options.frames = 900;
    EXPECT_EQ(screenshot_interval(options), 30);
    options.screenshot_every = 7;
    EXPECT_EQ(screenshot_interval(options), 7);
}

}  // namespace
}  // namespace osteomill::offscreen_run_test
