#include "render_client/ui/input/keyboard.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

constexpr std::size_t space = 32;

TEST(HeldKeys, StayDownThroughTheRepeatsOfARemoteDesktop) {
    HeldKeys keys;
    EXPECT_TRUE(keys.press(space, 0.0));
    for (double now_s = 0.5; now_s < 2.0; now_s += 0.03) {
        keys.release(space, now_s);
        EXPECT_FALSE(keys.settle(now_s + 0.02));
        EXPECT_TRUE(keys.down()[space]);
        EXPECT_FALSE(keys.press(space, now_s + 0.025)) << "it is no second press";
    }
    EXPECT_FALSE(keys.is_settling());
    EXPECT_FALSE(keys.settle(10.0));
    EXPECT_TRUE(keys.down()[space]);
}

TEST(HeldKeys, AreUpOnceTheyHaveNotComeBackInTime) {
    HeldKeys keys;
    EXPECT_TRUE(keys.press(space, 0.0));
    keys.release(space, 1.0);
    keys.release(space, 1.03);  // it is up: that is nothing new
    EXPECT_TRUE(keys.is_settling());
    EXPECT_TRUE(keys.settle(1.0 + HeldKeys::longest_gap_s));
    EXPECT_FALSE(keys.down()[space]);
    EXPECT_FALSE(keys.is_settling());
    EXPECT_TRUE(keys.press(space, 1.1));
}

TEST(HeldKeys, GoDownAnewThoughNobodyLookedBetween) {
    HeldKeys keys;
    keys.press(space, 0.0);
    keys.release(space, 1.0);
    EXPECT_TRUE(keys.press(space, 2.0));
}

TEST(HeldKeys, AreHeldEachByItself) {
    HeldKeys keys;
    keys.press(space, 0.0);
    keys.press(65, 0.0);
    keys.release(65, 1.0);
    EXPECT_TRUE(keys.settle(1.1));
    EXPECT_TRUE(keys.down()[space]);
    EXPECT_FALSE(keys.down()[65]);
}

}  // namespace
}  // namespace osteomill
