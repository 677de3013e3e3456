#include "devices/hid/space_mouse.h"

#include <gtest/gtest.h>

#include <atomic>
#include <glm/geometric.hpp>

#include "tests/support/eventually.h"
#include "tests/support/fake_hid.h"

namespace osteomill {
namespace {

using testing::eventually;
using testing::FakeHidDevice;

std::array<std::uint8_t, 7> axes_report(std::uint8_t number, int x, int y, int z) {
    std::array<std::uint8_t, 7> bytes{number};
    const std::array fields{x, y, z};
    for (std::size_t i = 0; i < 3; ++i) {
        bytes[1 + 2 * i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(fields[i]) & 0xFF);
        bytes[2 + 2 * i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(fields[i]) >> 8);
    }
    return bytes;
}

TEST(SpaceMouseState, TurnsThePucksAxesIntoThoseOfADesk) {
    SpaceMouseState state;
    ASSERT_TRUE(state.take(axes_report(1, 350, 350, 350)));
    EXPECT_LT(glm::distance(state.translation, {1.0, -1.0, -1.0}), 1e-12);
    ASSERT_TRUE(state.take(axes_report(2, 10, -700, 0)));
    EXPECT_EQ(state.rotation, glm::dvec3(0.0, 1.0, 0.0))
        << "a puck at rest is not quite centred, none goes farther";
    const std::array<std::uint8_t, 3> buttons{3, 0x02, 0x01};
    ASSERT_TRUE(state.take(buttons));
    EXPECT_EQ(state.buttons, 0x102u);
}

TEST(SpaceMouseState, TakesAllSixAxesInOneReport) {
    std::array<std::uint8_t, 13> bytes{1};
    bytes[7] = 0x5E;
    bytes[8] = 0x01;  // 350
    SpaceMouseState state;
    ASSERT_TRUE(state.take(bytes));
    EXPECT_EQ(state.rotation.x, 1.0);
}

TEST(SpaceMouseState, PassesOverWhatItDoesNotKnow) {
    SpaceMouseState state;
    const std::array<std::uint8_t, 7> report = axes_report(1, 350, 0, 0);
    EXPECT_FALSE(state.take(std::span(report).first(0)));
    EXPECT_FALSE(state.take(std::span(report).first(6)));
    EXPECT_FALSE(state.take(axes_report(23, 350, 0, 0)));
    EXPECT_EQ(state.translation, glm::dvec3(0.0));
}

class PluggedMouse : public ::testing::Test {
  protected:
    PluggedMouse() { hid.plug({.info = {path, 0x256F, 0xC635, 0x0001, 0x0008, "SpaceMouse"}}); }
    void send(std::span<const std::uint8_t> report) {
        hid.with([&](FakeHidDevice& device) { device.send(report); }, path);
    }
    DeviceState step() { return mouse.read(session_s += 0.001); }

    const std::string path = "/dev/hidraw1";
    Scene scene = [] {
        Scene desk;
        desk.burrs.resize(2);
        desk.start_pose.position_mm = {1.0, 2.0, 3.0};
        return desk;
    }();
    testing::FakeHid hid;
    std::atomic<double> thread_s{0.0};
    double session_s = 0.0;
    SpaceMouse mouse{scene, ArmModel{}, hand_model(Grip::firm), hid, [this] { return thread_s.load(); },
                     [] {}};
};

TEST_F(PluggedMouse, MovesTheToolWhileItIsPushedAndLeavesItWhereItIs) {
    mouse.start();
    send(axes_report(1, 350, 0, 0));
    ASSERT_TRUE(eventually([&] { return step().position_mm.x > 6.0; }));
    send(axes_report(1, 0, 0, 0));
    const std::array<std::uint8_t, 2> both_buttons{3, 3};
    send(both_buttons);
    ASSERT_TRUE(eventually([&] { return step().pedal.is_down; }))
        << "so it has been read that the puck is at rest";
    for (int i = 0; i < 3000; ++i) step();
    const glm::dvec3 rests_mm = step().position_mm;
    for (int i = 0; i < 1000; ++i) step();
    EXPECT_LT(glm::distance(step().position_mm, rests_mm), 0.2);
    EXPECT_EQ(step().burr, 1u) << "the right button was pressed once";
    EXPECT_NEAR(rests_mm.y, 2.0, 0.2);
}

TEST_F(PluggedMouse, IsLetGoWhereItSaysNothingMore) {
    mouse.start();
    send(axes_report(1, 0, 0, 350));
    ASSERT_TRUE(eventually([&] { return step().position_mm.z < 1.0; }));
    thread_s.store(1.0);
    ASSERT_TRUE(eventually([&] {
        const double before_mm = step().position_mm.z;
        for (int i = 0; i < 500; ++i) step();
        return std::abs(step().position_mm.z - before_mm) < 0.05;
    }));
}

TEST_F(PluggedMouse, IsLostWhenTheThreadThatReadsItHangs) {
    mouse.start();
    const std::array<std::uint8_t, 2> left_button{3, 1};
    send(left_button);
    ASSERT_TRUE(eventually([&] { return step().pedal.is_down; }));
    hid.with(
        [&](FakeHidDevice&) {  // the thread waits for it
            EXPECT_TRUE(eventually([&] {
                for (int i = 0; i < 250; ++i) step();
                const DeviceState state = step();
                return !state.connected;
            }));
        },
        path);
    EXPECT_TRUE(eventually([&] { return step().pedal.is_down; })) << "it is heard again";
}

TEST_F(PluggedMouse, IsLostWhenUnplugged) {
    mouse.start();
    ASSERT_TRUE(eventually([&] { return step().connected; }));
    hid.unplug(path);
    EXPECT_TRUE(eventually([&] { return !step().connected; }));
}

}  // namespace
}  // namespace osteomill
