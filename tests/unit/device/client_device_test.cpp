#include "haptic_server/device/client_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {
namespace {

const ToolPose start{{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}};

struct Desk {
    TripleBuffer<OperatorInput> input;
    ClientDevice device{input, start, DeviceMapping{}, ArmModel{}, hand_model(Grip::firm)};
    int tick = 0;

    void say(const OperatorInput& what) {
        input.back() = what;
        input.publish();
    }
    DeviceState run(int ticks) {
        DeviceState state;
        for (int i = 0; i < ticks; ++i) state = device.read(0.001 * tick++);
        return state;
    }
};

OperatorInput wants(const glm::dvec3& position_mm) {
    return {.hand_target = {position_mm, {0.0, 0.0, 1.0}}, .pedal = true, .burr = 2, .present = true};
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
    desk.say(wants({11.0, 2.0, 3.0}));
    const DeviceState state = desk.run(3000);
    EXPECT_NEAR(state.position_mm.x, 11.0, 1.0);
    EXPECT_TRUE(state.pedal);
    EXPECT_EQ(state.burr, 2u);
}

TEST(ClientDevice, MovesNoFasterThanAHandHoweverFarTheMouseJumps) {
    Desk desk;
    desk.run(1);
    desk.say(wants({1000.0, 2.0, 3.0}));
    double before_mm = desk.run(1).position_mm.x;
    for (int i = 0; i < 2000; ++i) {
        const double now_mm = desk.run(1).position_mm.x;
        ASSERT_LT(now_mm - before_mm, 1.0) << "per ms, at tick " << i;
        before_mm = now_mm;
    }
}

TEST(ClientDevice, LiftsThePedalAndHoldsStillWhenTheOperatorIsLost) {
    Desk desk;
    desk.say(wants({50.0, 2.0, 3.0}));
    desk.run(100);
    OperatorInput gone = wants({50.0, 2.0, 3.0});
    gone.present = false;
    desk.say(gone);
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

    OperatorInput no_axis = wants({20.0, 2.0, 3.0});
    no_axis.hand_target.spindle_axis = glm::dvec3(0.0);
    desk.say(no_axis);
    state = desk.run(100);
    EXPECT_FALSE(state.pedal);
    EXPECT_TRUE(std::isfinite(state.spindle_axis.x));
}

TEST(ClientDevice, TurnsTheSpindleOverSmoothly) {
    Desk desk;
    OperatorInput tilted = wants(start.position_mm);
    tilted.hand_target.spindle_axis = {3.0, 0.0, 3.0};  // any length
    desk.say(tilted);
    const DeviceState state = desk.run(1000);
    EXPECT_NEAR(state.spindle_axis.x, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(glm::length(state.spindle_axis), 1.0, 1e-12);
}

}  // namespace
}  // namespace osteomill
