#include "devices/simulated/simulated_device.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "common/scene/device_mapping.h"

namespace osteomill::simulated_device_test {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

Trajectory line(double length_mm, double duration_s) {
    return Trajectory({{0.0, {{0.0, 0.0, 0.0}, up}, true, std::nullopt},
                       {duration_s, {{length_mm, 0.0, 0.0}, up}, false, 1}});
}

SimulatedDevice device_on(Trajectory trajectory, const DeviceMapping& mapping = {}) {
    return SimulatedDevice(std::move(trajectory), mapping, ArmModel{}, hand_model(Grip::firm));
}

TEST(SimulatedDevice, FollowsItsTrajectoryInFreeAir) {
    auto device = device_on(line(10.0, 2.0));
    DeviceState state;
    for (int tick = 0; tick <= 3000; ++tick) state = device.read(0.001 * tick);
    EXPECT_NEAR(state.position_mm.x, 10.0, 1.0) << "friction may hold it back by 0.26 N / 0.3 N/mm";
    EXPECT_TRUE(device.is_finished());
    EXPECT_FALSE(state.pedal.is_down);
    EXPECT_TRUE(state.connected);
}

TEST(SimulatedDevice, OnRailsIsWhereTheTrajectoryHasItWhateverTheForce) {
    const DeviceMapping mapping{.scale = 2.0, .offset_mm = {1.0, 2.0, 3.0}};
    SimulatedDevice device(line(10.0, 2.0), mapping, limits_of(ArmModel{}));
    for (int tick = 0; tick <= 2000; ++tick) {
        const DeviceState state = device.read(0.001 * tick);
        device.write({-3.0, 1.0, 0.0});
        const glm::dvec3 in_patient_mm = position_in_patient_mm(mapping, state.position_mm);
        ASSERT_NEAR(in_patient_mm.x, 0.005 * tick, 1e-5) << tick;
        ASSERT_NEAR(glm::length(glm::dvec2(in_patient_mm.y, in_patient_mm.z)), 0.0, 1e-9) << tick;
        ASSERT_EQ(state.pedal.is_down, tick > 0 && tick < 2000) << tick;
        ASSERT_NEAR(state.velocity_mm_per_s.x, tick > 0 ? 2.5 : 0.0, 1e-2) << "in device space";
    }
    EXPECT_TRUE(device.is_finished());
}

TEST(SimulatedDevice, IsTheSameEachTime) {
    const auto run = [] {
        auto device = device_on(line(10.0, 1.0));
        glm::dvec3 sum(0.0);
        for (int tick = 0; tick < 1000; ++tick) {
            const DeviceState state = device.read(0.001 * tick);
            sum += state.position_mm + state.velocity_mm_per_s;
            device.write(-0.1 * state.position_mm);
        }
        return sum;
    };
    EXPECT_EQ(run(), run());
}

TEST(SimulatedDevice, YieldsToTheForceThatIsWritten) {
    auto device = device_on(Trajectory({{0.0, {{0.0, 0.0, 0.0}, up}, false, std::nullopt}}));
    for (int tick = 0; tick <= 3000; ++tick) {
        device.read(0.001 * tick);
        device.write({0.0, 1.26, 0.0});
    }
    // 1.26 N less at most, more at least, 0.26 N of friction on 0.3 N/mm.
    const double y_mm = device.held_arm().truth().position_mm().y;
    EXPECT_GT(y_mm, 1.0 / 0.3 - 0.01);
    EXPECT_LT(y_mm, 1.52 / 0.3 + 0.01);
}

TEST(SimulatedDevice, WaitsForAToolThatIsHeldBack) {
    auto free = device_on(line(20.0, 2.0));
    auto held = device_on(line(20.0, 2.0));
    int finished_at = 0;
    for (int tick = 0; tick <= 6000 && !held.is_finished(); ++tick) {
        free.read(0.001 * tick);
        const DeviceState state = held.read(0.001 * tick);
        // Honey: 0.15 N s/mm.
        held.write(-0.15 * state.velocity_mm_per_s);
        finished_at = tick;
    }
    EXPECT_GT(finished_at, 3000);
    EXPECT_TRUE(held.is_finished());
}

TEST(SimulatedDevice, EndsItsTrajectoryEvenAgainstAWall) {
    auto device = device_on(line(50.0, 1.0));
    int tick = 0;
    for (; tick <= 25000 && !device.is_finished(); ++tick) {
        const DeviceState state = device.read(0.001 * tick);
        device.write({-1.5 * std::max(0.0, state.position_mm.x), 0.0, 0.0});
    }
    EXPECT_TRUE(device.is_finished());
    EXPECT_GT(tick, 5000);
}

TEST(SimulatedDevice, SpeaksDeviceSpace) {
    // Device x is patient y, turned a quarter about z; twice as large; moved.
    const DeviceMapping mapping{
        .rotation = glm::dmat3({0, 1, 0}, {-1, 0, 0}, {0, 0, 1}), .scale = 2.0, .offset_mm = {5.0, 6.0, 7.0}};
    const ToolPose pose{{5.0, 26.0, 7.0}, {0.0, 1.0, 0.0}};
    auto device = device_on(Trajectory({{0.0, pose, false, std::nullopt}}), mapping);
    const DeviceState state = device.read(0.0);
    EXPECT_NEAR(state.position_mm.x, 10.0, 0.055);
    EXPECT_NEAR(state.position_mm.y, 0.0, 0.055);
    EXPECT_NEAR(state.spindle_axis.x, 1.0, 1e-12);
}

TEST(SimulatedDevice, ForgetsItsForceWhenStopped) {
    auto device = device_on(Trajectory({{0.0, {{0.0, 0.0, 0.0}, up}, false, std::nullopt}}));
    device.write({3.0, 0.0, 0.0});
    device.stop();
    device.read(0.05);
    EXPECT_EQ(device.held_arm().truth().position_mm(), glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill::simulated_device_test
