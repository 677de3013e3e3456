#include "devices/bridge/bridge_arm.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <glm/geometric.hpp>
#include <thread>

#include "simulation/device/arm_spring.h"
#include "tests/support/eventually.h"
#include "tests/unit/devices/bridge/bridge_pair.h"

namespace osteomill {
namespace {

using namespace std::chrono_literals;

/// An arm on a thread of its own, over a real socket.
class BridgedArm : public ::testing::Test {
  protected:
    BridgedArm()
        : device(BridgePath{folder / "arm"},
                 {.burr_count = 3, .start_burr = 1, .start_axis = {0.0, 1.0, 0.0}, .random = [this] {
                      return ++random_ * 0x9e3779b97f4a7c15U;
                  }}) {}
    ~BridgedArm() override { end(); }

    void begin(const omb_arm& arm, const omb_pose& first) {
        pose = first;
        const std::string address = "unix:" + (folder / "arm").string();
        ASSERT_EQ(omb_open(&link, address.c_str(), nullptr, &arm), 0) << link.error;
        thread = std::thread([this] {
            while (!stops.load()) {
                omb_force got;
                {
                    const std::lock_guard lock(mutex);
                    omb_exchange(&link, &pose, &got);
                    force = got;
                }
                std::this_thread::sleep_for(1ms);
            }
            omb_close(&link);
        });
        ASSERT_TRUE(device.await(testing::far_too_late()));
    }
    void end() {
        stops = true;
        if (thread.joinable()) thread.join();
    }
    void set(const omb_pose& next) {
        const std::lock_guard lock(mutex);
        pose = next;
    }
    omb_force given() {
        const std::lock_guard lock(mutex);
        return force;
    }
    /// A tick as the loop does it.
    DeviceState tick(const glm::dvec3& force_n) {
        now_s += 0.001;
        const DeviceState state = device.read(now_s);
        device.write(force_n);
        std::this_thread::sleep_for(1ms);
        return state;
    }
    /// Ticks until `is_so` of a state.
    template <typename Condition>
    ::testing::AssertionResult becomes(Condition is_so, const glm::dvec3& force_n = {}) {
        for (int i = 0; i < 60'000; ++i)
            if (is_so(tick(force_n))) return ::testing::AssertionSuccess();
        return ::testing::AssertionFailure();
    }

    testing::TemporaryFolder folder;
    std::uint64_t random_ = 1;
    BridgeArm device;
    std::mutex mutex;
    omb_pose pose{};
    omb_force force{};
    omb_link link{};
    std::atomic<bool> stops{false};
    std::thread thread;
    double now_s = 0.0;
};

TEST_F(BridgedArm, IsWhatTheArmSaysItIs) {
    begin(testing::some_arm(), testing::ready_pose());
    EXPECT_EQ(device.name(), "test arm");
    EXPECT_EQ(device.limits().max_force_n, 3.0);
    EXPECT_LE(device.limits().max_stiffness_n_per_mm, 1.5);
    EXPECT_EQ(device.limits().max_stiffness_n_per_mm,
              stiffest_spring({.claimed_n_per_mm = 1.5, .mass_kg = 0.05, .delay_s = device.round_trip_s()})
                  .stiffness_n_per_mm);
    EXPECT_EQ(device.limits().apparent_mass_kg, 0.05);
    EXPECT_GT(device.round_trip_s(), 0.0);
}

TEST_F(BridgedArm, MovesTheToolAndFeelsItsForce) {
    omb_pose at = testing::ready_pose();
    begin(testing::some_arm(), at);
    EXPECT_TRUE(becomes([](const DeviceState& state) { return state.connected && !state.pedal.is_down; }));
    at.position_mm[1] = 7.0;
    at.buttons = OMB_PEDAL | OMB_NEXT_BURR;
    set(at);
    EXPECT_TRUE(becomes([](const DeviceState& state) {
        return state.connected && state.pedal.is_down && state.position_mm.y == 7.0 && state.burr == 2u;
    }));
    EXPECT_TRUE(becomes([&](const DeviceState&) { return given().force_n[0] == -0.5; }, {-0.5, 0.0, 0.0}));
}

TEST_F(BridgedArm, WithoutAnOrientationHasTheScenes) {
    omb_pose at = testing::ready_pose();
    at.status = OMB_READY;
    begin(testing::some_arm(), at);
    EXPECT_TRUE(becomes([](const DeviceState& state) {
        return state.connected && state.spindle_axis == glm::dvec3(0.0, 1.0, 0.0);
    }));
}

// The hand holds the handle 100 mm above the burr.
TEST_F(BridgedArm, TheForceActsOnTheHandWithItsLever) {
    omb_arm arm = testing::some_arm();
    arm.tool_from_handle_mm[2] = -100.0;
    omb_pose at = testing::ready_pose();
    const double half = std::sqrt(0.5);
    at.quaternion[0] = half;  // turned by 90 degrees about x: the handle's z is -y of the device
    at.quaternion[1] = half;
    at.position_mm[0] = 3.0;
    begin(arm, at);
    EXPECT_TRUE(becomes(
        [](const DeviceState& state) {
            return state.connected && glm::length(state.position_mm - glm::dvec3(3.0, 100.0, 0.0)) < 1e-9 &&
                   glm::length(state.spindle_axis - glm::dvec3(0.0, -1.0, 0.0)) < 1e-9;
        },
        {0.5, 0.0, 0.0}));
    // The burr is 100 mm along y of the hand: (0, 100, 0) x (0.5, 0, 0).
    EXPECT_TRUE(becomes([&](const DeviceState&) { return std::abs(given().torque_n_mm[2] + 50.0) < 1e-6; },
                        {0.5, 0.0, 0.0}));
}

// A stylus that turns about the burr's centre: its handle goes round, the burr stands.
TEST_F(BridgedArm, TiltingAboutTheBurrDoesNotMoveIt) {
    omb_arm arm = testing::some_arm();
    arm.tool_from_handle_mm[2] = -60.0;
    begin(arm, [] {
        omb_pose first = testing::ready_pose();
        first.position_mm[2] = 60.0;
        return first;
    }());
    ASSERT_TRUE(becomes([](const DeviceState& state) { return state.connected; }));
    for (int degrees = 0; degrees <= 80; ++degrees) {
        omb_pose at = testing::ready_pose();
        const double angle = degrees * 0.017453292519943295;
        at.quaternion[0] = std::cos(angle / 2.0);
        at.quaternion[2] = std::sin(angle / 2.0);
        at.position_mm[0] = 60.0 * std::sin(angle);
        at.position_mm[2] = 60.0 * std::cos(angle);
        set(at);
        const DeviceState state = tick({});
        EXPECT_LT(glm::length(state.position_mm), 1e-9);
        EXPECT_LT(glm::length(state.velocity_mm_per_s), 1e-6);
    }
    EXPECT_TRUE(becomes([](const DeviceState& state) { return state.spindle_axis.x > 0.98; }));
}

TEST_F(BridgedArm, IsLostWhenItIsSilentAndSaysSo) {
    omb_pose at = testing::ready_pose();
    at.buttons = OMB_PEDAL;
    begin(testing::some_arm(), at);
    ASSERT_TRUE(becomes([](const DeviceState& state) { return state.connected && state.pedal.is_down; }));
    end();
    EXPECT_TRUE(becomes([](const DeviceState& state) { return !state.connected; }));
    EXPECT_TRUE(becomes([&](const DeviceState&) {
        return std::string(device.notice()) == "no arm is heard: is its bridge running?";
    }));
}

TEST_F(BridgedArm, IsNotThereWhileItIsNotReady) {
    omb_pose at = testing::ready_pose();
    begin(testing::some_arm(), at);
    ASSERT_TRUE(becomes([](const DeviceState& state) { return state.connected; }));
    at.status = OMB_HAS_ORIENTATION;
    set(at);
    EXPECT_TRUE(becomes([](const DeviceState& state) { return !state.connected; }));
    EXPECT_TRUE(becomes([&](const DeviceState&) {
        return std::string(device.notice()).find("not ready") != std::string::npos;
    }));
}

TEST_F(BridgedArm, IsToldThatThereIsNoForceWhenTheLoopStops) {
    begin(testing::some_arm(), testing::ready_pose());
    ASSERT_TRUE(becomes([&](const DeviceState&) { return given().force_n[2] == 1.0; }, {0.0, 0.0, 1.0}));
    EXPECT_TRUE(testing::eventually([&] { return given().is_off == 1 && given().force_n[2] == 0.0; }));
}

TEST_F(BridgedArm, WaitingForItCanBeGivenUp) {
    int asked = 0;
    EXPECT_FALSE(device.await([&] { return ++asked > 3; }));
}

}  // namespace
}  // namespace osteomill
