// The driver's conversation with an arm, against the arm's firmware as it is known, on time that the test
// makes.
#include "devices/hid/arm_link.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "devices/hid/arm_profile.h"
#include "tests/support/fake_hid.h"
#include "tests/support/virtual_arm.h"

namespace osteomill {
namespace {

using testing::FakeHid;
using testing::FakeHidDevice;
using ::testing::HasSubstr;
using testing::Report;
using testing::VirtualArm;
using State = ArmLink::State;

constexpr double tick_s = 0.001;
const glm::dvec3 nothing_n(0.0);

/// An arm on a desk and the driver's end of its cable.
class Bench {
  public:
    explicit Bench(const ArmProfile& with = load_arm_profile("woodenhaptics_v2015"))
        : profile(with), arm(with) {
        FakeHidDevice device;
        device.on_report = [this](FakeHidDevice& self, const Report& report) {
            arm.take(std::span(report).subspan(1), now_s);
            if (answers) self.send(arm.report());
        };
        hid.plug(device);
        connection = hid.open("/dev/hidraw0");
        link = std::make_unique<ArmLink>(profile, *connection, now_s);
    }

    /// One exchange a millisecond.
    void run(int exchanges, const std::optional<glm::dvec3>& wanted_n = nothing_n) {
        for (int i = 0; i < exchanges; ++i) {
            now_s += tick_s;
            link->receive(0, now_s);
            link->answer(now_s, wanted_n);
        }
    }
    void calibrate() {
        run(20);
        arm.ask_for_calibration();
        run(5);
    }
    void send(std::span<const std::uint8_t> report) {
        hid.with([&](FakeHidDevice& device) { device.send(report); });
    }
    Report last_sent() {
        return hid.with([](const FakeHidDevice& device) { return device.from_host.back(); });
    }
    std::size_t sent() {
        return hid.with([](const FakeHidDevice& device) { return device.from_host.size(); });
    }

    double now_s = 0.0;
    ArmProfile profile;
    VirtualArm arm;
    bool answers = true;
    FakeHid hid;
    std::unique_ptr<HidConnection> connection;
    std::unique_ptr<ArmLink> link;
};

const Report zero_currents(15, 0);

TEST(ArmLink, WakesASilentArmWithZeroCurrentsAfterTenMilliseconds) {
    Bench bench;
    bench.run(9);
    EXPECT_EQ(bench.sent(), 0u);
    bench.run(1);
    EXPECT_EQ(bench.sent(), 1u);
    EXPECT_EQ(bench.last_sent(), zero_currents);
    bench.run(5);
    EXPECT_EQ(bench.sent(), 6u) << "it answers a report with a report";
}

TEST(ArmLink, ReadsNoPositionAndGivesNoForceBeforeTheArmIsCalibrated) {
    Bench bench;
    bench.run(300, glm::dvec3(0.0, 0.0, 0.05));
    EXPECT_EQ(bench.link->state(), State::uncalibrated);
    EXPECT_FALSE(bench.link->reading().connected);
    EXPECT_THAT(bench.link->notice(), HasSubstr("press the calibration switch"));
    EXPECT_EQ(bench.arm.currents_ma(), (std::array<int, 3>{}));
}

TEST(ArmLink, SetsTheCountersWhenTheArmAsks) {
    Bench bench;
    bench.calibrate();
    EXPECT_EQ(bench.arm.calibrations(), 1u);
    EXPECT_TRUE(bench.link->reading().connected);
    EXPECT_LT(glm::distance(bench.link->reading().position_mm, {25.0, 0.0, 205.0}), 1e-9);
    EXPECT_STREQ(bench.link->notice(), "");
}

TEST(ArmLink, TakesAnArmThatIsCalibratedAtPowerUpForWhereItWas) {
    ArmProfile profile = load_arm_profile("woodenhaptics_v2015");
    profile.calibration = CalibrationMethod::at_power_up;
    Bench bench(profile);
    bench.run(20);
    EXPECT_TRUE(bench.link->reading().connected);
    EXPECT_LT(glm::distance(bench.link->reading().position_mm, {25.0, 0.0, 205.0}), 1e-9);
}

TEST(ArmLink, NegatesAndOffsetsTheCountsOfTheFirstGeneration) {
    ArmProfile profile = load_arm_profile("woodenhaptics_v2015");
    profile.calibration = CalibrationMethod::at_power_up;
    Bench bench(profile);
    bench.answers = false;
    // Counts 0, 0, 3000: half of the 6000 of home are left, body C at 45 degrees.
    const std::array<std::uint8_t, 8> report{0, 0, 0, 0, 0xB8, 0x0B, 0, 0};
    bench.send(report);
    bench.run(1);
    bench.send(report);
    bench.run(1);
    const double c_rad = 0.25 * 3.14159265358979323846;
    const glm::dvec3 expected(245.0 * std::sin(c_rad) - 220.0, 0.0,
                              80.0 + 205.0 - 245.0 * std::cos(c_rad) - 80.0);
    EXPECT_LT(glm::distance(bench.link->reading().position_mm, expected), 1e-9);
    EXPECT_EQ(bench.last_sent().size(), 9u) << "answered in kind";
}

TEST(ArmLink, GivesTheForceThatIsWantedOnceASmallOneWas) {
    Bench bench;
    bench.calibrate();
    EXPECT_EQ(bench.link->state(), State::driving) << "nothing was wanted, which is small";
    bench.run(3, glm::dvec3(0.3, -0.2, 0.5));
    EXPECT_LT(glm::distance(bench.arm.force_n(bench.now_s), {0.3, -0.2, 0.5}), 0.01);
}

TEST(ArmLink, MeetsNoHandWithAForceThatWasThereBefore) {
    Bench bench;
    bench.run(20, glm::dvec3(0.0, 0.0, 2.0));
    bench.arm.ask_for_calibration();
    bench.run(500, glm::dvec3(0.0, 0.0, 2.0));
    EXPECT_EQ(bench.link->state(), State::waiting);
    EXPECT_EQ(bench.arm.currents_ma(), (std::array<int, 3>{}));
    bench.run(1, nothing_n);
    bench.run(2, glm::dvec3(0.0, 0.0, 2.0));
    EXPECT_NE(bench.arm.currents_ma(), (std::array<int, 3>{}));
}

TEST(ArmLink, CapsItsCurrents) {
    Bench bench;
    bench.calibrate();
    bench.run(3, glm::dvec3(0.0, 500.0, 0.0));
    EXPECT_EQ(bench.arm.currents_ma()[0], 1999);
    bench.run(3, glm::dvec3(0.0, NAN, 0.0));
    EXPECT_EQ(bench.arm.currents_ma(), (std::array<int, 3>{}));
}

TEST(ArmLink, LetsGoOfAForceThatNobodyRenews) {
    Bench bench;
    bench.calibrate();
    bench.run(3, glm::dvec3(0.0, 0.0, 1.0));
    ASSERT_NE(bench.arm.currents_ma(), (std::array<int, 3>{}));
    bench.run(25, std::nullopt);
    EXPECT_NE(bench.arm.currents_ma(), (std::array<int, 3>{})) << "in no single step";
    bench.run(30, std::nullopt);
    EXPECT_EQ(bench.arm.currents_ma(), (std::array<int, 3>{}));
    bench.run(5, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(bench.arm.currents_ma(), (std::array<int, 3>{})) << "and not before a small one is wanted";
}

TEST(ArmLink, AnswersOnlyTheNewestOfManyReports) {
    Bench bench;
    bench.calibrate();
    bench.arm.move_to({30.0, 0.0, 205.0});
    for (int i = 0; i < 50; ++i) bench.send(bench.arm.report());
    bench.arm.move_to({40.0, 5.0, 200.0});
    bench.send(bench.arm.report());
    const std::size_t before = bench.sent();
    bench.run(1);
    EXPECT_LT(glm::distance(bench.link->reading().position_mm, {40.0, 5.0, 200.0}), 0.1);
    EXPECT_EQ(bench.sent(), before + 1);
}

TEST(ArmLink, PassesOverReportsThatAreShortLongOrMeanNothing) {
    Bench bench;
    bench.calibrate();
    const glm::dvec3 before_mm = bench.link->reading().position_mm;
    bench.answers = false;
    std::array<std::uint8_t, 64> garbage{};
    garbage.fill(0x5A);
    std::uint64_t sent = 0;
    bench.run(1);
    for (const std::size_t size : {1u, 7u, 8u, 13u, 14u, 15u, 64u}) {
        bench.send(std::span(garbage).first(size));
        bench.run(1);
        EXPECT_EQ(bench.link->malformed_count(), ++sent) << size;
        EXPECT_EQ(bench.link->reading().position_mm, before_mm) << size;
    }
}

TEST(ArmLink, IsSilentAfterTwentyMillisecondsAndGoneAfterHalfASecond) {
    Bench bench;
    bench.calibrate();
    bench.run(3, glm::dvec3(0.0, 0.0, 0.05));
    bench.answers = false;
    bench.run(22, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_FALSE(bench.link->reading().connected);
    EXPECT_EQ(bench.link->state(), State::waiting);
    EXPECT_EQ(bench.last_sent(), zero_currents);
    bench.answers = true;
    bench.run(15);
    EXPECT_TRUE(bench.link->reading().connected) << "it was only slow";
    bench.answers = false;
    bench.run(510);
    EXPECT_EQ(bench.link->state(), State::gone);
}

TEST(ArmLink, IsGoneAtOnceWhenItIsUnplugged) {
    Bench bench;
    bench.calibrate();
    bench.hid.unplug();
    bench.run(1);
    EXPECT_EQ(bench.link->state(), State::gone);
    EXPECT_FALSE(bench.link->reading().connected);
}

TEST(ArmLink, StopsTheForceWhenItsCalibrationSwitchIsPressedInTheMiddle) {
    Bench bench;
    bench.calibrate();
    bench.run(3, glm::dvec3(0.0, 0.0, 0.05));
    bench.run(3, glm::dvec3(0.0, 0.0, 1.0));
    bench.arm.ask_for_calibration();
    bench.run(2, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_FALSE(bench.link->reading().connected);
    bench.run(40, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(bench.arm.currents_ma(), (std::array<int, 3>{}));
    EXPECT_EQ(bench.arm.calibrations(), 2u);
}

TEST(ArmLink, HasNoForceWhileTheClutchIsPressed) {
    ArmProfile profile = load_arm_profile("woodenhaptics_v2015");
    profile.switch_use = SwitchUse::pedal_and_clutch;
    Bench bench(profile);
    bench.calibrate();
    for (const bool pressed : {true, false, true}) {
        bench.arm.press_switch(pressed);
        bench.run(50, glm::dvec3(0.0, 0.0, 0.05));
    }
    const glm::dvec3 tool_mm = bench.link->reading().position_mm;
    bench.arm.move_to({60.0, 0.0, 190.0});
    bench.run(5, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(bench.link->reading().position_mm, tool_mm);
    EXPECT_FALSE(bench.link->reading().pedal.is_down);
    EXPECT_EQ(bench.arm.currents_ma(), (std::array<int, 3>{}));
}

TEST(ArmLink, LeavesTheMotorsWithoutCurrent) {
    Bench bench;
    bench.calibrate();
    bench.run(3, glm::dvec3(0.0, 0.0, 0.05));
    bench.run(3, glm::dvec3(0.0, 0.0, 1.0));
    bench.link.reset();
    EXPECT_EQ(bench.last_sent(), zero_currents);
}

}  // namespace
}  // namespace osteomill
