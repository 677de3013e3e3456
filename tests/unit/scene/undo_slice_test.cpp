#include "common/scene/undo_slice.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

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
