#include "haptic_server/measuring/arm_measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/haply/haply_arm.h"
#include "devices/hid/arm_kinematics.h"
#include "devices/hid/arm_profile.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/device/measured_arm.h"
#include "tests/support/bench/fine_arm.h"

namespace osteomill::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A fine arm to which something happens after so many ticks.
class Eventful final : public HapticDevice {
  public:
    Eventful(const FineFigures& figures, int ticks, std::function<void(FineArm&)> event)
        : arm(figures, 5), ticks_(ticks), event_(std::move(event)) {}
    std::string name() const override { return arm.name(); }
    DeviceLimits limits() const override { return arm.limits(); }
    void start() override { started = true; }
    void stop() noexcept override { stopped = true; }
    DeviceState read(double now_s) noexcept override {
        if (ticks_-- == 0) event_(arm);
        return arm.read(now_s);
    }
    void write(const glm::dvec3& force_n) noexcept override { arm.write(force_n); }

    FineArm arm;
    bool started = false;
    bool stopped = false;

  private:
    int ticks_;
    std::function<void(FineArm&)> event_;
};

const std::atomic<bool> never{false};

TEST(ArmMeasurement, FindsTheSimulatedArm) {
    for (const Grip grip : {Grip::light, Grip::firm}) {
        SimulatedDevice device(Trajectory({{.time_s = 0.0, .pose = {}, .pedal = true}}), DeviceMapping{},
                               ArmModel{}, hand_model(grip));
        const ArmMeasurement found = measure_arm(device, {.delay_s = 0.0, .is_virtual = true, .stop = never});
        ASSERT_TRUE(found.has_spring()) << text_of(found.end);
        EXPECT_NEAR(found.arm.step_mm, 0.055, 1e-6);
        EXPECT_LT(found.arm.noise_mm, 0.01);
        EXPECT_LT(*found.arm.delay_s, 0.0003);
        EXPECT_NEAR(*found.arm.moving_mass_kg, 0.045 + hand_model(grip).mass_kg, 0.02);
        EXPECT_NEAR(*found.arm.friction_n, 0.26, 0.05);
        const DeviceLimits stated = device.limits();
        const DeviceLimits gets = with_measured_spring(stated, 0.0, found.arm);
        EXPECT_GT(gets.max_stiffness_n_per_mm, 1.1 * stated.max_stiffness_n_per_mm) << "beyond its claim";
        const std::string text = text_of(found, device.name(), stated, 0.0);
        for (const char* row : {"encoder step", "noise", "delay", "moving mass", "friction",
                                "stiffest calm spring", "spring so far", "spring from now on"})
            EXPECT_THAT(text, HasSubstr(row));
        EXPECT_THAT(text, Not(HasSubstr("not measured")));
    }
}

TEST(ArmMeasurement, FindsALateArm) {
    SimulatedDevice device(Trajectory({{.time_s = 0.0, .pose = {}, .pedal = true}}), DeviceMapping{},
                           ArmModel{.mass_kg = 0.1, .coulomb_friction_n = 0.1, .delay_ms = 2},
                           hand_model(Grip::light));
    const ArmMeasurement found = measure_arm(device, {.delay_s = 0.0, .is_virtual = true, .stop = never});
    ASSERT_TRUE(found.has_spring()) << text_of(found.end);
    EXPECT_NEAR(*found.arm.delay_s, 0.002, 0.0003);
    EXPECT_GT(found.swinging_n_per_mm, 0.0);
}

/// The arms that are shipped, as simulated ones: those over USB and Haply's a tick late.
std::vector<std::pair<std::string, ArmModel>> shipped_arms() {
    std::vector<std::pair<std::string, ArmModel>> arms{{"simulated", ArmModel{}}};
    for (const std::string& name : shipped_profile_names()) {
        const ArmProfile profile = load_arm_profile(name);
        arms.emplace_back(name, ArmModel{.mass_kg = profile.apparent_mass_kg,
                                         .resolution_mm = ArmKinematics(profile).resolution_mm(),
                                         .max_force_n = profile.max_force_n,
                                         .max_stiffness_n_per_mm = 0.001 * profile.max_stiffness_n_per_m,
                                         .delay_ms = 1});
    }
    arms.emplace_back("inverse3", ArmModel{.mass_kg = inverse3_profile.apparent_mass_kg,
                                           .resolution_mm = inverse3_profile.position_step_mm,
                                           .max_force_n = inverse3_profile.max_force_n,
                                           .max_stiffness_n_per_mm = inverse3_profile.max_stiffness_n_per_mm,
                                           .delay_ms = 1});
    return arms;
}

TEST(ArmMeasurement, GivesEachShippedArmMoreThanItClaimsAndNoMoreThanTheArmAloneBears) {
    for (const auto& [name, arm] : shipped_arms()) {
        SimulatedDevice device(Trajectory({{.time_s = 0.0, .pose = {}, .pedal = true}}), DeviceMapping{}, arm,
                               hand_model(Grip::light));
        const double delay_s = 0.001 * arm.delay_ms;
        const ArmMeasurement found =
            measure_arm(device, {.delay_s = delay_s, .is_virtual = true, .stop = never});
        ASSERT_TRUE(found.has_spring()) << name << ": " << text_of(found.end);
        const DeviceLimits stated = device.limits();
        const DeviceLimits gets = with_measured_spring(stated, delay_s, found.arm);
        std::printf(
            "%s: step %.3f mm, %.1f ticks, %.0f g, %.2f N, calm %.2f N/mm; %.2f -> %.2f N/mm beside %.1f N "
            "s/m (%s)\n",
            name.c_str(), found.arm.step_mm, 1e3 * *found.arm.delay_s, 1e3 * *found.arm.moving_mass_kg,
            *found.arm.friction_n, found.arm.calm_n_per_mm, stated.max_stiffness_n_per_mm,
            gets.max_stiffness_n_per_mm, 1e3 * gets.damping_n_s_per_mm, gets.stiffness_is_limited_by);
        EXPECT_GT(gets.max_stiffness_n_per_mm, 1.1 * stated.max_stiffness_n_per_mm) << name;
        EXPECT_LE(gets.max_stiffness_n_per_mm,
                  2.0 / 3.0 * stiffest_wall_n_per_mm(arm.mass_kg, gets.damping_n_s_per_mm, 1.0) + 1e-9)
            << name;
    }
}

TEST(ArmMeasurement, SaysWhatItCouldNotMeasure) {
    FineFigures stuck{.step_mm = 0.055};
    stuck.arm.coulomb_friction_n = 6.0;
    Eventful device(stuck, -1, [](FineArm&) {});
    const ArmMeasurement found = measure_arm(device, {.is_virtual = true, .stop = never});
    EXPECT_EQ(found.not_measured.size(), 4U) << "three axes, and steps that nothing crossed";
    EXPECT_FALSE(found.arm.moving_mass_kg || found.arm.friction_n || found.arm.delay_s);
    const std::string text = text_of(found, "stuck", device.limits(), 0.001);
    EXPECT_THAT(text, HasSubstr("not measured: mass, friction and delay along y"));
}

TEST(ArmMeasurement, EndsWithoutForceWhateverHappens) {
    const auto ended = [](int ticks, std::function<void(FineArm&)> event) {
        Eventful device({.step_mm = 0.02}, ticks, std::move(event));
        const ArmMeasurement found = measure_arm(device, {.is_virtual = true, .stop = never});
        EXPECT_TRUE(device.started && device.stopped);
        EXPECT_EQ(device.arm.last_written_n(), glm::dvec3(0.0));
        EXPECT_FALSE(found.has_spring());
        EXPECT_FALSE(found.not_measured.empty());
        return found.end;
    };
    for (const int ticks : {500, 4000, 9000}) {  // in the rest, the push, the ramp
        EXPECT_EQ(ended(ticks, [](FineArm& arm) { arm.pedal = false; }), MeasuringEnd::pedal_up) << ticks;
        EXPECT_EQ(ended(ticks, [](FineArm& arm) { arm.is_there = false; }), MeasuringEnd::arm_lost) << ticks;
    }
}

TEST(ArmMeasurement, EndsWhenItIsStopped) {
    std::atomic<bool> stop{false};
    Eventful device({}, 9000, [&stop](FineArm&) { stop.store(true); });
    const ArmMeasurement found = measure_arm(device, {.is_virtual = true, .stop = stop});
    EXPECT_EQ(found.end, MeasuringEnd::none);
    EXPECT_FALSE(found.has_spring());
    EXPECT_EQ(device.arm.last_written_n(), glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill::testing
