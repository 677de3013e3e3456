#include "common/scene/stroke_span.h"

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

}  // namespace
}  // namespace osteomill
