#include "common/session/stroke_span.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(StrokeSpan, BeginsWhenTheTurningBurrTouchesBone) {
    StrokeSpan span;
    EXPECT_FALSE(span.goes_on(0.0, true, false, false)) << "it turns in air";
    EXPECT_FALSE(span.goes_on(0.1, false, false, true)) << "it stands on bone";
    EXPECT_TRUE(span.goes_on(0.2, true, false, true));
}

TEST(StrokeSpan, LastsThroughAGapOfLessThanHalfASecond) {
    StrokeSpan span;
    EXPECT_TRUE(span.goes_on(1.0, true, true, true));
    EXPECT_TRUE(span.goes_on(1.4, true, false, false));
    EXPECT_FALSE(span.touches());
    EXPECT_TRUE(span.goes_on(1.45, true, true, true));
    EXPECT_TRUE(span.goes_on(1.9, true, false, false));
    EXPECT_FALSE(span.goes_on(1.95, true, false, false)) << "though the pedal is down";
    EXPECT_TRUE(span.goes_on(2.0, true, false, true)) << "the next";
}

TEST(StrokeSpan, EndsWithThePedalOnceNoMoreBoneGoes) {
    StrokeSpan span;
    EXPECT_TRUE(span.goes_on(1.0, true, true, true));
    EXPECT_TRUE(span.goes_on(1.03, false, true, true)) << "the milling loop is a step behind";
    EXPECT_FALSE(span.goes_on(1.06, false, false, true));
}

constexpr double frame_s = 0.1;

TEST(UndoSlice, EndsWithItsStroke) {
    UndoSlice slice;
    EXPECT_FALSE(slice.ends(10.0, true, true));
    EXPECT_FALSE(slice.ends(10.1, true, false));
    EXPECT_TRUE(slice.ends(10.2, false, false));
}

TEST(UndoSlice, OfALatchedPedalEndsAfterThreeSecondsOfCutting) {
    UndoSlice slice;
    double now_s = 10.0;
    int ended = 0;
    for (int frame = 0; frame < 720; ++frame) ended += slice.ends(now_s += frame_s, true, true) ? 1 : 0;
    EXPECT_GE(ended, 23);
    EXPECT_LE(ended, 24);
}

TEST(UndoSlice, CountsNoTimeInAir) {
    UndoSlice slice;
    double now_s = 0.0;
    for (int frame = 0; frame < 100; ++frame) EXPECT_FALSE(slice.ends(now_s += frame_s, true, false));
    for (int frame = 0; frame < 29; ++frame) EXPECT_FALSE(slice.ends(now_s += frame_s, true, true)) << frame;
}

}  // namespace
}  // namespace osteomill
