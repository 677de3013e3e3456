#include "devices/client/client_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/scene/device_mapping.h"
#include "tests/support/latched_pedal.h"

namespace osteomill::client_device_test {
namespace {

const ToolPose start{{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}};

struct Desk {
    OperatorChannel input;
    ClientDevice::Time now{};
    ClientDevice device{
        input, start, DeviceMapping{}, ArmModel{}, hand_model(Grip::firm), [this] { return now; }};
    testing::LatchedPedal pedal;
    int tick = 0;
    bool turns = false;  // the spindle, were there no bone

    void say(const std::optional<OperatorCommand>& what, std::uint64_t client = 1) {
        input.back() = {.command = what, .heard = now, .client = client};
        input.publish();
    }
    DeviceState read(double now_s) {
        now = ClientDevice::Time(
            std::chrono::duration_cast<ClientDevice::Time::duration>(std::chrono::duration<double>(now_s)));
        const DeviceState state = device.read(now_s);
        turns = pedal.reads(state, now_s);
        return state;
    }
    DeviceState run(int ticks) {
        DeviceState state;
        for (int i = 0; i < ticks; ++i) state = read(0.001 * tick++);
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

OperatorCommand wants(const glm::dvec3& position_mm, bool pedal = true) {
    return {.hand_target_mm = position_mm, .pedal = pedal, .burr = 2};
}

TEST(ClientDevice, RestsAtTheStartPoseUntilAnOperatorComes) {
    Desk desk;
    const DeviceState state = desk.run(500);
    EXPECT_LT(glm::distance(state.position_mm, start.position_mm), 0.1);
    EXPECT_FALSE(desk.turns);
    EXPECT_FALSE(state.burr.has_value());
}

TEST(ClientDevice, GoesWhereTheOperatorPoints) {
    Desk desk;
    const DeviceState state = desk.run_while_saying(wants({11.0, 2.0, 3.0}), 3000);
    EXPECT_NEAR(state.position_mm.x, 11.0, 1.0);
    EXPECT_TRUE(state.pedal.is_down);
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

TEST(ClientDevice, TellsOfAPedalThatWasUpBetweenTwoReads) {
    Desk desk;
    const auto says_down = [&](std::uint64_t releases) {
        desk.input.back() = {
            .command = wants(start.position_mm), .heard = desk.now, .client = 1, .releases = releases};
        desk.input.publish();
        desk.run(2);
    };
    says_down(0);
    EXPECT_FALSE(desk.turns) << "held from the start on";
    says_down(1);
    EXPECT_TRUE(desk.turns) << "released and pressed anew";
    desk.run(300);
    says_down(1);
    EXPECT_FALSE(desk.turns) << "held through a silence";
    says_down(2);
    EXPECT_TRUE(desk.turns);
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
    desk.run_while_saying(wants({5.0, 2.0, 3.0}, false), 20);
    desk.run_while_saying(wants({5.0, 2.0, 3.0}), 101);  // the last at 120 ms
    EXPECT_TRUE(desk.turns);
    desk.run(198);
    EXPECT_TRUE(desk.turns);
    desk.run(3);
    EXPECT_FALSE(desk.turns) << "though nobody says that the operator has gone";
    desk.run(1000);
    const double rests_mm = desk.run(1).position_mm.x;
    EXPECT_NEAR(desk.run(500).position_mm.x, rests_mm, 0.06);
    desk.run_while_saying(wants({5.0, 2.0, 3.0}), 500);
    EXPECT_FALSE(desk.turns) << "heard again, and still held";
    desk.run_while_saying(wants({5.0, 2.0, 3.0}, false), 20);
    EXPECT_FALSE(desk.turns);
    desk.run_while_saying(wants({5.0, 2.0, 3.0}), 20);
    EXPECT_TRUE(desk.turns) << "pressed anew";
}

TEST(ClientDevice, GoesByTheTimeOfTheTickHoweverFewTicksThereAre) {
    Desk desk;
    desk.read(0.85);
    desk.say(wants({5.0, 2.0, 3.0}, false));
    desk.read(0.9);
    desk.say(wants({5.0, 2.0, 3.0}));
    desk.read(1.0);
    ASSERT_TRUE(desk.turns);
    desk.read(1.3);
    EXPECT_FALSE(desk.turns);

    Desk stalled;
    stalled.read(0.85);
    stalled.say(wants({5.0, 2.0, 3.0}, false));
    stalled.read(0.9);
    stalled.say(wants({5.0, 2.0, 3.0}));
    stalled.read(1.0);
    ASSERT_TRUE(stalled.turns);
    stalled.say(wants({5.0, 2.0, 3.0}));
    stalled.read(1.3);
    EXPECT_FALSE(stalled.turns) << "no tick saw that it had ended";
    stalled.say(wants({5.0, 2.0, 3.0}));
    stalled.read(1.31);
    EXPECT_FALSE(stalled.turns) << "held all the time";
}

TEST(ClientDevice, PassesNoPedalOnFromOneOperatorToTheNext) {
    Desk desk;
    desk.run_while_saying(wants({5.0, 2.0, 3.0}, false), 20);
    desk.run_while_saying(wants({5.0, 2.0, 3.0}), 20);
    ASSERT_TRUE(desk.turns);
    desk.say(wants({5.0, 2.0, 3.0}), 2);
    desk.run(50);
    EXPECT_FALSE(desk.turns) << "the second one held it before";
}

TEST(ClientDevice, TakesACommandForAsOldAsItIs) {
    Desk desk;
    desk.run_while_saying(wants({5.0, 2.0, 3.0}, false), 20);
    desk.input.back() = {
        .command = wants({5.0, 2.0, 3.0}), .heard = desk.now - std::chrono::milliseconds(300), .client = 1};
    desk.input.publish();
    desk.run(5);
    EXPECT_FALSE(desk.turns) << "it lay in a queue while the program was stopped";
}

TEST(ClientDevice, LiftsThePedalAndHoldsStillWhenTheOperatorIsLost) {
    Desk desk;
    desk.run_while_saying(wants({50.0, 2.0, 3.0}, false), 20);
    desk.run_while_saying(wants({50.0, 2.0, 3.0}), 100);
    ASSERT_TRUE(desk.turns);
    desk.say(std::nullopt);
    desk.run(1);
    EXPECT_FALSE(desk.turns);
    desk.run(1000);
    const double rests_mm = desk.run(1).position_mm.x;
    EXPECT_LT(rests_mm, 40.0);
    EXPECT_NEAR(desk.run(1000).position_mm.x, rests_mm, 0.06);
}

TEST(ClientDevice, IsNotPulledBackFromItsNewPlaceByAClientThatHasNotHeardOfIt) {
    Desk desk;
    const glm::dvec3 old_target(1.0, 2.0, -1.0);
    glm::dvec3 in_device_mm = desk.run_while_saying(wants(old_target), 500).position_mm;
    // The patient is moved away under the burr by 20 mm, as the loop does it when bone comes back.
    const DeviceMapping lifted{.offset_mm = {0.0, 0.0, 20.0}};
    desk.device.set_mapping(lifted);
    const glm::dvec3 placed_mm = position_in_patient_mm(lifted, in_device_mm);
    const DeviceState state = desk.run_while_saying(wants(old_target), 1000);
    EXPECT_LT(glm::distance(state.position_mm, in_device_mm), 0.2);
    EXPECT_FALSE(state.pedal.is_down) << "it was pressed for other bone";
    in_device_mm = state.position_mm;

    // It has heard, and moves on from there.
    const DeviceState moved = desk.run_while_saying(wants(placed_mm + glm::dvec3(4.0, 0.0, 0.0)), 500);
    EXPECT_NEAR(moved.position_mm.x - in_device_mm.x, 4.0, 1.0);
    // One that goes back to the old place means it, now.
    EXPECT_LT(desk.run_while_saying(wants(old_target), 1500).position_mm.z, in_device_mm.z - 3.0);
}

TEST(ClientDevice, GoesWhereAClientPointsThatNeverHearsOfItsNewPlace) {
    Desk desk;
    const glm::dvec3 target(1.0, 2.0, 2.0);
    const double before_mm = desk.run_while_saying(wants(target), 500).position_mm.z;
    desk.device.set_mapping({.offset_mm = {0.0, 0.0, 5.0}});
    const int unheard = static_cast<int>(1000.0 * ClientDevice::unheard_s);
    EXPECT_NEAR(desk.run_while_saying(wants(target), unheard).position_mm.z, before_mm, 0.2);
    EXPECT_LT(desk.run_while_saying(wants(target), 1000).position_mm.z, before_mm - 3.0);
}

TEST(ClientDevice, PassesOverInputThatIsNotFinite) {
    Desk desk;
    desk.say(wants({NAN, 2.0, 3.0}));
    DeviceState state = desk.run(100);
    EXPECT_FALSE(state.pedal.is_down);
    EXPECT_LT(glm::distance(state.position_mm, start.position_mm), 0.1);

    OperatorCommand no_axis = wants({20.0, 2.0, 3.0});
    no_axis.spindle_axis = glm::dvec3(0.0);
    desk.say(no_axis);
    state = desk.run(100);
    EXPECT_FALSE(state.pedal.is_down);
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
