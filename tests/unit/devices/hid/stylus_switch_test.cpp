#include <gtest/gtest.h>

#include "devices/hid/arm_link.h"
#include "devices/position_sensor.h"

namespace osteomill {
namespace {

TEST(StylusSwitch, IsThePedalWhilePressed) {
    StylusSwitch pedal(SwitchUse::pedal);
    for (const double now_s : {0.0, 0.1, 0.2}) {
        pedal.read(true, now_s);
        EXPECT_TRUE(pedal.is_pedal() && !pedal.is_clutch());
        pedal.read(false, now_s + 0.05);
        EXPECT_FALSE(pedal.is_pedal());
    }
}

TEST(StylusSwitch, IsTheClutchPressedTwiceAndHeld) {
    StylusSwitch both(SwitchUse::pedal_and_clutch);
    both.read(true, 0.0);
    EXPECT_TRUE(both.is_pedal()) << "a first press, at session time zero, is no second one";
    both.read(false, 0.1);
    both.read(true, 0.2);
    EXPECT_TRUE(both.is_clutch() && !both.is_pedal());
    both.read(true, 5.0);
    EXPECT_TRUE(both.is_clutch()) << "for as long as it is held";
    both.read(false, 5.1);
    EXPECT_FALSE(both.is_clutch() || both.is_pedal());
    both.read(true, 6.0);
    EXPECT_TRUE(both.is_pedal()) << "pressed again at leisure";
}

TEST(Clutch, KeepsTheToolWhereItWasWhileTheHandMoves) {
    Clutch clutch;
    EXPECT_EQ(clutch.position_mm({1.0, 2.0, 3.0}, false), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(clutch.position_mm({9.0, 2.0, 3.0}, true), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(clutch.position_mm({11.0, 2.0, 3.0}, true), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(clutch.position_mm({12.0, 2.0, 3.0}, false), glm::dvec3(2.0, 2.0, 3.0))
        << "and goes on from there";
}

}  // namespace
}  // namespace osteomill
