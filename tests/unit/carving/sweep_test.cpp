#include "simulation/carving/sweep.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(Sweep, LineThroughABallIsAChord) {
    const Interval chord = line_through_ball({1.0, 2.0, 3.0}, 5.0, 2.0, 7.0);  // 4 from the middle
    EXPECT_DOUBLE_EQ(chord.first, 1.0 - 3.0);
    EXPECT_DOUBLE_EQ(chord.last, 1.0 + 3.0);
    EXPECT_TRUE(line_through_ball({1.0, 2.0, 3.0}, 5.0, 2.0, 8.5).empty());
}

TEST(Sweep, VolumeOfACapsuleIsABallAndACylinder) {
    EXPECT_NEAR(volume(Sweep{{0, 0, 0}, {0, 3, 4}, 2.0}), 3.14159265358979 * (4.0 * 5.0 + 32.0 / 3.0), 1e-9);
}

}  // namespace
}  // namespace osteomill
