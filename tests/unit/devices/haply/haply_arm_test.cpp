#include "devices/haply/haply_arm.h"

#include <gmock/gmock.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <thread>

#include "simulation/device/arm_spring.h"
#include "tests/support/eventually.h"
#include "tests/support/haply_service.h"
#include "tests/support/latched_pedal.h"

namespace osteomill {
namespace {

using namespace std::chrono_literals;
using testing::eventually;
using testing::HaplyService;
using ::testing::HasSubstr;

/// The arm's driver against a service on a real socket; the test ticks it as the loop does.
class HaplyArmOnService : public ::testing::Test {
  protected:
    /// Without a tick.
    void find(bool is_new = true) {
        service.emplace(is_new);
        devices.position_m = {0.01, -0.12, 0.15};
        service->set(devices);
        arm.emplace(HaplyArm::Parts{.service = {.port = service->port()},
                                    .burr_count = 3,
                                    .start_burr = 1,
                                    .start_axis = {0.0, 1.0, 0.0}});
        ASSERT_TRUE(arm->await(testing::far_too_late()));
    }
    void begin(bool is_new = true) {
        find(is_new);
        ASSERT_TRUE(becomes([](const DeviceState& state) { return state.connected; }));
    }
    /// A tick as the loop does it.
    DeviceState tick(const glm::dvec3& force_n) {
        now_s += 0.001;
        const DeviceState state = arm->read(now_s);
        arm->write(state.connected ? force_n : glm::dvec3(0.0));
        std::this_thread::sleep_for(1ms);
        return state;
    }
    /// Ticks until `is_so` of a state.
    template <typename Condition>
    ::testing::AssertionResult becomes(Condition is_so, const glm::dvec3& force_n = {}) {
        for (int i = 0; i < 60'000; ++i)
            if (is_so(tick(force_n))) return ::testing::AssertionSuccess();
        return ::testing::AssertionFailure() << arm->notice();
    }
    ::testing::AssertionResult is_felt(const glm::dvec3& force_n) {
        return becomes([&](const DeviceState&) { return glm::length(*service->force_n() - force_n) < 1e-5; },
                       force_n);
    }
    ::testing::AssertionResult is_lost() {
        return becomes([](const DeviceState& state) { return !state.connected; }, {1.0, 0.0, 0.0});
    }
    ::testing::AssertionResult is_back() {
        return becomes([](const DeviceState& state) { return state.connected; });
    }
    ::testing::AssertionResult says(const std::string& words) {
        return becomes(
            [&](const DeviceState&) { return std::string(arm->notice()).find(words) != std::string::npos; });
    }

    HaplyService::Devices devices;
    std::optional<HaplyService> service;
    std::optional<HaplyArm> arm;
    double now_s = 0.0;
};

TEST_F(HaplyArmOnService, HasLimitsThatHoldWithItsDelay) {
    begin();
    EXPECT_EQ(arm->limits().max_force_n, inverse3_profile.max_force_n);
    EXPECT_GT(arm->delay_s(), 0.001);
    EXPECT_LE(arm->delay_s(), longest_delay_s);
    EXPECT_EQ(arm->limits().max_stiffness_n_per_mm,
              stiffest_spring({.claimed_n_per_mm = inverse3_profile.max_stiffness_n_per_mm,
                               .mass_kg = inverse3_profile.apparent_mass_kg,
                               .position_resolution_mm = inverse3_profile.position_step_mm,
                               .delay_s = arm->delay_s()})
                  .stiffness_n_per_mm);
}

TEST_F(HaplyArmOnService, MovesTheToolByPositionGripAndButtons) {
    begin();
    devices.position_m = {0.02, -0.1, 0.2};
    devices.velocity_m_per_s = glm::dvec3(0.1, 0.0, -0.05);
    devices.turn = glm::angleAxis(glm::radians(90.0), glm::dvec3(1.0, 0.0, 0.0));  // the grip points up
    devices.a = true;
    devices.b = true;
    service->set(devices);
    EXPECT_TRUE(becomes([](const DeviceState& state) {
        return state.connected && state.pedal.is_down && state.burr == 2u &&
               glm::length(state.position_mm - glm::dvec3(20.0, -100.0, 200.0)) < 1e-9 &&
               glm::length(state.velocity_mm_per_s - glm::dvec3(100.0, 0.0, -50.0)) < 1e-9 &&
               glm::length(state.spindle_axis - glm::dvec3(0.0, 0.0, -1.0)) < 1e-9;
    }));
    devices.a = devices.b = false;
    service->set(devices);
    EXPECT_TRUE(becomes([](const DeviceState& state) { return !state.pedal.is_down && state.burr == 2u; }));
    devices.b = true;
    service->set(devices);
    EXPECT_TRUE(becomes([](const DeviceState& state) { return state.burr == 0u; }));
    EXPECT_EQ(std::string(arm->notice()), "");
}

TEST_F(HaplyArmOnService, FeelsItsForceInEitherDialect) {
    for (const bool is_new : {false, true}) {
        arm.reset();
        begin(is_new);
        EXPECT_TRUE(is_felt({}));
        EXPECT_TRUE(is_felt({-0.5, 1.25, 2.0}));
        EXPECT_EQ(service->odd_messages(), 0);
    }
}

TEST_F(HaplyArmOnService, GetsNoMoreForceThanItBears) {
    begin();
    ASSERT_TRUE(is_felt({}));
    EXPECT_TRUE(becomes(
        [&](const DeviceState&) { return service->force_n()->z > inverse3_profile.max_force_n - 1e-5; },
        {0.0, 0.0, 50.0}));
    for (int i = 0; i < 50; ++i) tick({30.0, -40.0, 50.0});
    EXPECT_LE(service->largest_force_n(), inverse3_profile.max_force_n + 1e-5);
    EXPECT_TRUE(becomes([&](const DeviceState&) { return *service->force_n() == glm::dvec3(0.0); },
                        {std::nan(""), 0.0, 0.0}));
}

TEST_F(HaplyArmOnService, MeetsNoHandWithAForceThatWasThereBefore) {
    find();
    const int before = service->messages();
    EXPECT_TRUE(eventually([&] {
        arm->write({2.0, 0.0, 0.0});
        return service->messages() > before + 50;
    }));
    EXPECT_EQ(service->largest_force_n(), 0.0);
    EXPECT_TRUE(eventually([&] { return !arm->read(now_s).connected; })) << "or it would not know";
    EXPECT_TRUE(is_felt({0.05, 0.0, 0.0}));
    EXPECT_TRUE(is_felt({2.0, 0.0, 0.0}));
}

TEST_F(HaplyArmOnService, LosesTheForceThatTheLoopDoesNotRenew) {
    begin();
    ASSERT_TRUE(is_felt({}));
    ASSERT_TRUE(is_felt({2.0, 0.0, 0.0}));
    EXPECT_TRUE(eventually([&] { return *service->force_n() == glm::dvec3(0.0); }));
    EXPECT_TRUE(eventually([&] { return !arm->read(now_s).connected; })) << "or it would not know";
    EXPECT_TRUE(is_felt({2.0, 0.0, 0.0}));
}

TEST_F(HaplyArmOnService, TakesTheForceOffAtItsEnd) {
    begin();
    ASSERT_TRUE(is_felt({}));
    ASSERT_TRUE(is_felt({2.0, 0.0, 0.0}));
    arm->stop();
    EXPECT_EQ(*service->force_n(), glm::dvec3(0.0));
    EXPECT_FALSE(arm->read(now_s + 1.0).connected);
}

TEST_F(HaplyArmOnService, IsLostWhileTheServiceIsSilent) {
    begin();
    devices.a = true;
    service->set(devices);
    ASSERT_TRUE(is_felt({}));
    ASSERT_TRUE(is_felt({1.0, 0.0, 0.0}));
    service->set(HaplyService::Mood::silent);
    EXPECT_TRUE(is_lost());
    EXPECT_TRUE(eventually([&] { return *service->force_n() == glm::dvec3(0.0); }))
        << "it is told all the same";
    EXPECT_TRUE(says("silent"));
    service->set(HaplyService::Mood::answers);
    EXPECT_TRUE(is_back());
    EXPECT_TRUE(is_felt({0.5, 0.0, 0.0}));
}

TEST_F(HaplyArmOnService, IsLostWhileTheServiceTalksNonsense) {
    begin();
    ASSERT_TRUE(is_felt({}));
    for (const std::string& garbage :
         {std::string("}{"), std::string(100'000, '['), std::string(300'000, ' '),
          std::string("\xff\x00\x01", 3),
          std::string(R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":NaN}}}]})")}) {
        service->set_garbage(garbage);
        service->set(HaplyService::Mood::garbage);
        EXPECT_TRUE(is_lost());
        EXPECT_TRUE(becomes([&](const DeviceState&) { return std::string(arm->notice()) != ""; }));
        service->set(HaplyService::Mood::answers);
        EXPECT_TRUE(is_back());
        EXPECT_TRUE(is_felt({0.5, 0.0, 0.0}));
        EXPECT_TRUE(is_felt({}));
    }
}

TEST_F(HaplyArmOnService, IsLostWhileItIsUnpluggedAndComesBackWithoutAForce) {
    begin();
    devices.a = true;
    service->set(devices);
    ASSERT_TRUE(is_felt({}));
    ASSERT_TRUE(is_felt({2.0, 0.0, 0.0}));
    devices.has_arm = false;
    service->set(devices);
    EXPECT_TRUE(is_lost());
    EXPECT_TRUE(eventually([&] { return *service->force_n() == glm::dvec3(0.0); }));
    EXPECT_TRUE(says("not there any more"));
    devices.has_arm = true;
    devices.position_m.x = 0.05;
    service->set(devices);
    EXPECT_TRUE(becomes([](const DeviceState& state) {
        return state.connected && state.pedal.is_down && std::abs(state.position_mm.x - 50.0) < 1e-9;
    }));
    EXPECT_EQ(*service->force_n(), glm::dvec3(0.0));
    EXPECT_TRUE(is_felt({0.05, 0.0, 0.0}));
}

// However short: the loop has to see it, or the force would come back at its full size.
TEST_F(HaplyArmOnService, IsLostForTheLoopEvenWhereItIsGoneForOneMessage) {
    begin();
    ASSERT_TRUE(is_felt({}));
    ASSERT_TRUE(is_felt({2.0, 0.0, 0.0}));
    service->set([answers = 0, at = devices](double, const glm::dvec3&) mutable {
        HaplyService::Devices once = at;
        once.has_arm = answers++ != 0;
        return once;
    });
    EXPECT_TRUE(is_lost());
    EXPECT_TRUE(is_back());
}

TEST_F(HaplyArmOnService, IsNotTakenForAnother) {
    begin();
    ASSERT_TRUE(is_felt({}));
    devices.arm_id = "0001";
    service->set(devices);
    EXPECT_TRUE(is_lost());
    EXPECT_TRUE(says("not there any more"));
    devices.arm_id = "049D";
    service->set(devices);
    EXPECT_TRUE(is_back());
}

TEST_F(HaplyArmOnService, IsBackAfterItsServiceHasBeenKilled) {
    begin();
    ASSERT_TRUE(is_felt({}));
    ASSERT_TRUE(is_felt({2.0, 0.0, 0.0}));
    service->kill();
    EXPECT_TRUE(is_lost());
    EXPECT_TRUE(says("does not answer: is it running"));
    service->live();
    EXPECT_TRUE(is_back());
    EXPECT_EQ(*service->force_n(), glm::dvec3(0.0));
    EXPECT_TRUE(is_felt({}));
    EXPECT_TRUE(is_felt({0.5, 0.0, 0.0}));
    EXPECT_EQ(service->connections(), 2);
}

TEST_F(HaplyArmOnService, IsNotThereWhileItIsNotCalibrated) {
    begin();
    devices.is_calibrated = false;
    service->set(devices);
    EXPECT_TRUE(is_lost());
    EXPECT_TRUE(says("not calibrated"));
    devices.is_calibrated = true;
    service->set(devices);
    EXPECT_TRUE(is_back());
}

TEST_F(HaplyArmOnService, WithoutAGripHasTheScenesAxisAndThenTheLastOne) {
    devices.has_grip = false;
    begin();
    EXPECT_TRUE(
        becomes([](const DeviceState& state) { return state.spindle_axis == glm::dvec3(0.0, 1.0, 0.0); }));
    EXPECT_TRUE(says("no VerseGrip"));
    devices.has_grip = devices.a = true;
    devices.turn = glm::angleAxis(glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
    service->set(devices);
    const auto stands = [](const DeviceState& state) {
        return glm::length(state.spindle_axis - glm::dvec3(0.0, 0.0, 1.0)) < 1e-9;
    };
    EXPECT_TRUE(becomes([&](const DeviceState& state) { return stands(state) && state.pedal.is_down; }));
    devices.has_grip = false;
    service->set(devices);
    EXPECT_TRUE(becomes([&](const DeviceState& state) { return !state.pedal.is_down; }));
    EXPECT_TRUE(stands(tick({})));
    EXPECT_TRUE(is_felt({0.05, 0.0, 0.0})) << "the arm goes on without it";
}

TEST_F(HaplyArmOnService, LetsTheHandGoElsewhereWithTheClutch) {
    begin();
    ASSERT_TRUE(is_felt({}));
    ASSERT_TRUE(is_felt({2.0, 0.0, 0.0}));
    devices.c = devices.a = true;
    service->set(devices);
    EXPECT_TRUE(
        becomes([&](const DeviceState&) { return *service->force_n() == glm::dvec3(0.0); }, {2.0, 0.0, 0.0}));
    devices.position_m.x += 0.03;
    service->set(devices);
    testing::LatchedPedal latch;
    for (int i = 0; i < 50; ++i) {
        const DeviceState state = tick({});
        EXPECT_NEAR(state.position_mm.x, 10.0, 1e-9);
        EXPECT_FALSE(latch.reads(state, now_s)) << "it is for drilling";
        EXPECT_EQ(state.velocity_mm_per_s, glm::dvec3(0.0));
    }
    devices.c = false;
    devices.position_m.x += 0.002;
    service->set(devices);
    EXPECT_TRUE(becomes([](const DeviceState& state) {
        return state.pedal.is_down && std::abs(state.position_mm.x - 12.0) < 1e-9;
    }));
    for (int i = 0; i < 50; ++i) EXPECT_FALSE(latch.reads(tick({}), now_s)) << "held through the clutch";
    devices.a = false;
    service->set(devices);
    EXPECT_TRUE(becomes([&](const DeviceState& state) {
        latch.reads(state, now_s);
        return !state.pedal.is_down;
    }));
    devices.a = true;
    service->set(devices);
    EXPECT_TRUE(becomes([&](const DeviceState& state) { return latch.reads(state, now_s); }))
        << "pressed anew";
}

TEST_F(HaplyArmOnService, CountsNoPressDuringTheClutch) {
    begin();
    testing::LatchedPedal latch;
    ASSERT_TRUE(
        becomes([&](const DeviceState& state) { return !latch.reads(state, now_s) && state.connected; }));
    devices.c = true;
    service->set(devices);
    for (int i = 0; i < 50; ++i) latch.reads(tick({}), now_s);
    devices.a = true;
    service->set(devices);
    EXPECT_TRUE(becomes([&](const DeviceState& state) {
        EXPECT_FALSE(latch.reads(state, now_s));
        return state.pedal.is_down;
    }));
    devices.c = false;
    devices.position_m.x += 0.002;
    service->set(devices);
    for (int i = 0; i < 50; ++i) EXPECT_FALSE(latch.reads(tick({}), now_s));
}

TEST(HaplyArmAlone, WaitsUntilItIsToldNotTo) {
    std::uint16_t port = 0;
    {
        HaplyService once;
        port = once.port();
    }
    HaplyArm arm(HaplyArm::Parts{.service = {.port = port}});
    EXPECT_FALSE(
        arm.await([&] { return std::string(arm.notice()).find("does not answer") != std::string::npos; }));
    EXPECT_FALSE(arm.read(0.0).connected);
}

}  // namespace
}  // namespace osteomill
