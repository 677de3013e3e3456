#include "render_client/ui/offscreen_run.h"

#include <filesystem>

#include "render_client/volume/picture.h"
#include "tests/unit/ui/scripted_session.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::offscreen_run_test {
namespace {

class OffscreenRunTest : public ::testing::Test {
  protected:
    void SetUp() override {
        try {
            const gl::OffscreenContext context;
        } catch (const gl::NoOpenGl& error) {
            GTEST_SKIP() << "needs OpenGL without a display: " << error.what();
        }
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
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

/// A session of which nothing is heard any more after its first polls, its burr at rest.
class StillSession final : public SessionSource {
  public:
    explicit StillSession(int polls_with_motion) : polls_left_(polls_with_motion) {}

    LinkUpdate poll() override {
        if (polls_left_-- > 0) {
            last_ = session_.poll();
            if (last_.tool) last_.tool->spindle_on = false;
            return last_;
        }
        LinkUpdate nothing_new;
        nothing_new.status = last_.status;
        nothing_new.status_line = last_.status_line;
        nothing_new.frames_per_s = last_.frames_per_s;
        return nothing_new;
    }
    const Bone* bone() const override { return session_.bone(); }
    const SessionInfo* session() const override { return session_.session(); }

  private:
    int polls_left_;
    ScriptedSession session_{1000};
    LinkUpdate last_;
};

/// How many frames, 1/30 s apart at the least, begin while a change settles, the first and the last with
/// them.
constexpr std::size_t most_settling_frames = 10;

TEST_F(OffscreenRunTest, DrawsAStillSceneNoMore) {
    options_.frames = 40;
    options_.screenshot_every = 20;
    StillSession session(5);
    const RenderReport report = run_offscreen(options_, session, never);
    EXPECT_GE(report.frame_times.count(), 1u);
    EXPECT_LE(report.frame_times.count(), 5 + most_settling_frames) << "of 40";
    for (const char* name : {"frame_0020.png", "frame_0040.png", "final.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    EXPECT_EQ(read_png(folder_ / "frame_0020.png").rgb, read_png(folder_ / "final.png").rgb);
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
