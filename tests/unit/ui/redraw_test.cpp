#include "render_client/ui/view/redraw.h"

#include <gtest/gtest.h>

#include <utility>

namespace osteomill::redraw_test {
namespace {

using std::chrono::milliseconds;

/// Frames drawn in a second with sixty polls, if this happens at each.
template <typename Happens>
int frames_in_a_second(Redraw& redraw, Redraw::Time began, Happens&& happens,
                       milliseconds frame = milliseconds(5)) {
    int frames = 0;
    for (int i = 0; i < 60; ++i) {
        const Redraw::Time now = began + milliseconds(1000 * i / 60);
        happens(now);
        if (!redraw.is_due(now)) continue;
        redraw.drew(now, frame);
        ++frames;
    }
    return frames;
}

const Redraw::Time start = Redraw::Time{} + std::chrono::hours(1);

TEST(Redraw, DrawsWhileThingsChangeAndALittleLonger) {
    Redraw redraw;
    EXPECT_EQ(frames_in_a_second(redraw, start, [&](Redraw::Time now) { redraw.note_change(now); }), 60);
    const int settling = frames_in_a_second(redraw, start + milliseconds(1000), [](Redraw::Time) {});
    EXPECT_GE(settling, 3);
    EXPECT_LE(settling, 16);
}

TEST(Redraw, DrawsTheEffectOfAnInputHoweverLongAFrameTakes) {
    Redraw redraw;
    redraw.note_change(start);
    int frames = 0;
    for (Redraw::Time now = start; redraw.is_due(now); now += milliseconds(600)) {
        redraw.drew(now, milliseconds(600));
        ++frames;
    }
    EXPECT_EQ(frames, Redraw::settling_frames);
}

TEST(Redraw, DrawsNothingWhereNothingChanges) {
    Redraw redraw;
    EXPECT_EQ(frames_in_a_second(redraw, start, [](Redraw::Time) {}), 0);
}

TEST(Redraw, DrawsFiguresOnceASecond) {
    Redraw redraw;
    const auto figures = [&](Redraw::Time) { redraw.note_figures(); };
    EXPECT_EQ(frames_in_a_second(redraw, start, figures), 1);
    EXPECT_EQ(frames_in_a_second(redraw, start + milliseconds(1000), figures), 1);
    EXPECT_EQ(frames_in_a_second(redraw, start + milliseconds(2000), [](Redraw::Time) {}), 1)
        << "the last ones, too";
}

TEST(Redraw, DrawsFiguresLessOftenWhereAFrameIsDear) {
    for (const auto& [frame_ms, most_in_ten_s] : {std::pair(25, 4), {5000, 2}}) {
        Redraw redraw;
        int frames = 0;
        for (int s = 0; s < 10; ++s)
            frames += frames_in_a_second(
                redraw, start + std::chrono::seconds(s), [&](Redraw::Time) { redraw.note_figures(); },
                milliseconds(frame_ms));
        EXPECT_LE(frames, most_in_ten_s) << frame_ms;
        EXPECT_GE(frames, 2) << frame_ms;
    }
}

}  // namespace
}  // namespace osteomill::redraw_test
