#include "simulation/loop/spindle_speed.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(SpindleSpeed, IsTheBurrsOwnUntilAnotherIsChosen) {
    SpindleSpeed speed({100.0, 500.0});
    EXPECT_EQ(speed.tick(0, 0.0, true, 0.001), 1.0);
    EXPECT_EQ(speed.tick(1, 0.0, true, 0.001), 1.0);
    EXPECT_EQ(SpindleSpeed({}).tick(0, 300.0, true, 0.001), 1.0) << "none can be chosen";
}

TEST(SpindleSpeed, OfASpindleThatStandsIsChosenAtOnce) {
    SpindleSpeed speed({100.0, 500.0});
    EXPECT_EQ(speed.tick(0, 200.0, false, 0.001), 2.0);
    EXPECT_EQ(speed.tick(1, 200.0, false, 0.001), 0.4) << "the same speed, of another burr";
}

TEST(SpindleSpeed, OfASpindleThatTurnsChangesAsAMotorDoes) {
    SpindleSpeed speed({100.0});
    double before = speed.tick(0, 0.0, true, 0.001);
    int ticks = 0;
    for (; before > 0.1 && ticks < 1000; ++ticks) {
        const double share = speed.tick(0, 10.0, true, 0.001);
        EXPECT_LE(share, before);
        EXPECT_GE(share, 0.98 * before);
        before = share;
    }
    EXPECT_EQ(before, 0.1);
    EXPECT_NEAR(ticks, 231, 2) << "ln 10 of change_s";
    for (int i = 0; i < 300; ++i) before = speed.tick(0, 0.0, true, 0.001);
    EXPECT_EQ(before, 1.0) << "and back";
}

}  // namespace
}  // namespace osteomill
