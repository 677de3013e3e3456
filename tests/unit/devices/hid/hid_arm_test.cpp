// The arm with its thread, as the haptic loop sees it.
#include "devices/hid/hid_arm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <glm/geometric.hpp>

#include "devices/hid/arm_profile.h"
#include "tests/support/eventually.h"
#include "tests/support/fake_hid.h"
#include "tests/support/virtual_arm.h"

namespace osteomill {
namespace {

using testing::eventually;
using testing::FakeHid;
using testing::FakeHidDevice;
using ::testing::HasSubstr;
using testing::Report;
using testing::VirtualArm;

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class PluggedArm : public ::testing::Test {
  protected:
    PluggedArm() { plug(); }

    void plug() {
        FakeHidDevice plugged;
        plugged.is_permitted = is_permitted;
        plugged.on_report = [this](FakeHidDevice& self, const Report& report) {
            arm.take(std::span(report).subspan(1), now_s());
            self.send(arm.report());
        };
        hid.plug(plugged);
    }
    /// Ticks as the loop does, every millisecond, until the reading is as it shall be.
    template <typename Condition>
    bool loop_until(const glm::dvec3& force_n, Condition&& condition) {
        return eventually([&] {
            const DeviceState state = device.read(session_s += 0.001);
            device.write(force_n);
            return condition(state);
        });
    }
    bool has_currents() {
        return hid.with([this](const FakeHidDevice&) { return arm.currents_ma() != std::array<int, 3>{}; });
    }
    void ask_for_calibration() {
        hid.with([this](const FakeHidDevice&) { arm.ask_for_calibration(); });
    }

    bool is_permitted = true;
    ArmProfile profile = load_arm_profile("woodenhaptics_v2015");
    VirtualArm arm{profile};
    FakeHid hid;
    double session_s = 0.0;
    HidArm device{profile, hid, now_s, [] {}};
};

const auto is_connected = [](const DeviceState& state) { return state.connected; };
const auto is_lost = [](const DeviceState& state) { return !state.connected; };

TEST_F(PluggedArm, IsLostWhenUnpluggedAndComesBackWhenPluggedInAndCalibratedAgain) {
    device.start();
    ask_for_calibration();
    ASSERT_TRUE(loop_until({}, is_connected));
    ASSERT_TRUE(loop_until({0.0, 0.0, 0.05}, [&](const DeviceState&) { return has_currents(); }));

    hid.unplug();
    ASSERT_TRUE(loop_until({0.0, 0.0, 1.0}, is_lost));
    EXPECT_TRUE(eventually([&] { return std::strstr(device.notice(), "plug it in again") != nullptr; }));

    arm.power_up();
    plug();
    ASSERT_TRUE(eventually([&] { return std::strstr(device.notice(), "calibration switch") != nullptr; }));
    EXPECT_FALSE(device.read(session_s += 0.001).connected) << "nobody knows yet where it is";
    ask_for_calibration();
    ASSERT_TRUE(loop_until({}, is_connected));
    device.stop();
    EXPECT_FALSE(has_currents());
}

TEST_F(PluggedArm, CountsAsLostWhenItsThreadTellsNothingNew) {
    device.start();
    ask_for_calibration();
    ASSERT_TRUE(loop_until({}, is_connected));
    device.stop();
    EXPECT_TRUE(loop_until({}, is_lost));
}

TEST_F(PluggedArm, SaysWhatIsMissingWhenItCannotBegin) {
    hid.unplug();
    try {
        device.start();
        FAIL() << "there is no arm";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("woodenhaptics_v2015 (USB 1234:0006, usage ffab:0200)"));
    }
    is_permitted = false;
    plug();
    EXPECT_THROW(device.start(), HidOpenError);
}

TEST_F(PluggedArm, NamesTheRuleWhenAnArmIsPluggedInThatItMayNotUse) {
    device.start();
    hid.unplug();
    is_permitted = false;
    plug();
    EXPECT_TRUE(eventually([&] { return std::strstr(device.notice(), "70-osteomill.rules") != nullptr; }));
}

TEST_F(PluggedArm, HasTheLimitsOfItsProfile) {
    const DeviceLimits limits = device.limits();
    EXPECT_EQ(limits.max_force_n, 5.0);
    EXPECT_NEAR(limits.max_stiffness_n_per_mm, 1.0, 1e-12);
    EXPECT_NEAR(limits.position_resolution_mm, 0.064, 0.001);
}

}  // namespace
}  // namespace osteomill
