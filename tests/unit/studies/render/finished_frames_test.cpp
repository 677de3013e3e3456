#include "render_client/volume/gl/framebuffer.h"
#include "studies/render/picture_trial.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::study {
namespace {

using FrameStopwatchTest = OffscreenTest;

TEST_F(FrameStopwatchTest, TimesEachFrameByThreeClocks) {
    const gl::Framebuffer framebuffer({32, 32});
    FrameStopwatch stopwatch;
    int drawn = 0;
    for (int frame = 0; frame < 3; ++frame)
        stopwatch.time([&] {
            ++drawn;
            framebuffer.bind();
            glClear(GL_COLOR_BUFFER_BIT);
            framebuffer.depth_at({0, 0});
        });
    EXPECT_EQ(drawn, 3);
    const FrameMilliseconds& read = stopwatch.frames();
    for (const std::vector<double>* times : {&read.wall, &read.gpu, &read.cpu}) {
        ASSERT_EQ(times->size(), 3U);
        for (const double time_ms : *times) EXPECT_GE(time_ms, 0.0);
    }
}

}  // namespace
}  // namespace osteomill::study
