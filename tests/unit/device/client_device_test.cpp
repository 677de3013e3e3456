#include "haptic_server/device/client_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill::client_device_test {
namespace {

const ToolPose start{{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}};

struct Desk {
    OperatorChannel input;
    ClientDevice device{input, start, DeviceMapping{}, ArmModel{}, hand_model(Grip::firm)};
    int tick = 0;

    void say(const std::optional<OperatorCommand>& what) {
        input.back() = what;
        input.publish();
    }
    DeviceState run(int ticks) {
        DeviceState state;
        for (int i = 0; i < ticks; ++i) state = device.read(0.001 * tick++);
        return state;
    }
    /// Says it again every 20 ms, as a client does.
    DeviceState run_while_saying(const std::optional<OperatorCommand>& what, int ticks) {
        DeviceState state;
        for (int i = 0; i < ticks; ++i) {
            if (i % 20 == 0) say(what);
            state = run(1);
        }
        return state;
    }
};

OperatorCommand wants(const glm::dvec3& position_mm) {
    return {.hand_target_mm = position_mm, .pedal = true, .burr = 2};
}

TEST(ClientDevice, RestsAtTheStartPoseUntilAnOperatorComes) {
    Desk desk;
    const DeviceState state = desk.run(500);
    EXPECT_LT(glm::distance(state.position_mm, start.position_mm), 0.1);
    EXPECT_FALSE(state.pedal);
    EXPECT_FALSE(state.burr.has_value());
}

TEST(ClientDevice, GoesWhereTheOperatorPoints) {
    Desk desk;
    const DeviceState state = desk.run_while_saying(wants({11.0, 2.0, 3.0}), 3000);
    EXPECT_NEAR(state.position_mm.x, 11.0, 1.0);
    EXPECT_TRUE(state.pedal);
    EXPECT_EQ(state.burr, 2u);
}

TEST(ClientDevice, MovesNoFasterThanAHandHoweverFarTheMouseJumps) {
    Desk desk;
    desk.run(1);
    double before_mm = desk.run(1).position_mm.x;
    for (int i = 0; i < 2000; ++i) {
        const double now_mm = desk.run_while_saying(wants({1000.0, 2.0, 3.0}), 1).position_mm.x;
        ASSERT_LT(now_mm - before_mm, 0.5) << "per ms, at tick " << i;
        before_mm = now_mm;
    }
}

TEST(ClientDevice, GoesNoFartherThanAReachForOneMessage) {
    Desk desk;
    desk.run(1);
    EXPECT_STREQ(desk.device.notice(), "");
    desk.say(wants(start.position_mm + glm::dvec3(100.0, 0.0, 0.0)));
    double farthest_mm = 0.0;
    for (int i = 0; i < 3000; ++i)
        farthest_mm = std::max(farthest_mm, glm::distance(desk.run(1).position_mm, start.position_mm));
    EXPECT_LT(farthest_mm, 1.5 * longest_reach_mm) << "a hand swings beyond where it stops";
    EXPECT_STRNE(desk.device.notice(), "");
}

TEST(ClientDevice, LiftsThePedalAndStandsStill200MsAfterTheNewestMessage) {
    Desk desk;
    ASSERT_TRUE(desk.run_while_saying(wants({5.0, 2.0, 3.0}), 101).pedal);  // the last at 100 ms
    EXPECT_TRUE(desk.run(199).pedal);
    EXPECT_FALSE(desk.run(2).pedal) << "though nobody says that the operator has gone";
    desk.run(1000);
    const double rests_mm = desk.run(1).position_mm.x;
    EXPECT_NEAR(desk.run(500).position_mm.x, rests_mm, 0.06);
    EXPECT_FALSE(desk.run_while_saying(wants({5.0, 2.0, 3.0}), 500).pedal) << "heard again, and still held";
    OperatorCommand lifted = wants({5.0, 2.0, 3.0});
    lifted.pedal = false;
    EXPECT_FALSE(desk.run_while_saying(lifted, 20).pedal);
    EXPECT_TRUE(desk.run_while_saying(wants({5.0, 2.0, 3.0}), 20).pedal) << "pressed anew";
}

TEST(ClientDevice, GoesByTheTimeOfTheTickHoweverFewTicksThereAre) {
    Desk desk;
    desk.say(wants({5.0, 2.0, 3.0}));
    ASSERT_TRUE(desk.device.read(1.0).pedal);
    EXPECT_FALSE(desk.device.read(1.3).pedal);

    Desk stalled;
    stalled.say(wants({5.0, 2.0, 3.0}));
    ASSERT_TRUE(stalled.device.read(1.0).pedal);
    stalled.say(wants({5.0, 2.0, 3.0}));
    EXPECT_FALSE(stalled.device.read(1.3).pedal) << "no tick saw that it had ended";
}

TEST(ClientDevice, LiftsThePedalAndHoldsStillWhenTheOperatorIsLost) {
    Desk desk;
    desk.run_while_saying(wants({50.0, 2.0, 3.0}), 100);
    desk.say(std::nullopt);
    EXPECT_FALSE(desk.run(1).pedal);
    desk.run(1000);
    const double rests_mm = desk.run(1).position_mm.x;
    EXPECT_LT(rests_mm, 40.0);
    EXPECT_NEAR(desk.run(1000).position_mm.x, rests_mm, 0.06);
}

TEST(ClientDevice, PassesOverInputThatIsNotFinite) {
    Desk desk;
    desk.say(wants({NAN, 2.0, 3.0}));
    DeviceState state = desk.run(100);
    EXPECT_FALSE(state.pedal);
    EXPECT_LT(glm::distance(state.position_mm, start.position_mm), 0.1);

    OperatorCommand no_axis = wants({20.0, 2.0, 3.0});
    no_axis.spindle_axis = glm::dvec3(0.0);
    desk.say(no_axis);
    state = desk.run(100);
    EXPECT_FALSE(state.pedal);
    EXPECT_TRUE(std::isfinite(state.spindle_axis.x));
}

TEST(ClientDevice, TurnsTheSpindleOverSmoothly) {
    Desk desk;
    OperatorCommand tilted = wants(start.position_mm);
    tilted.spindle_axis = {3.0, 0.0, 3.0};  // any length
    const DeviceState state = desk.run_while_saying(tilted, 1000);
    EXPECT_NEAR(state.spindle_axis.x, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(glm::length(state.spindle_axis), 1.0, 1e-12);
}

}  // namespace
}  // namespace osteomill::client_device_test
