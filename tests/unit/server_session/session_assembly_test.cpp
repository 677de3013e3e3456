#include "haptic_server/session/session_assembly.h"

#include <gmock/gmock.h>

#include <fstream>
#include <thread>
#include <vector>

#include "common/recording/playhead.h"
#include "devices/simulated/prescribed_device.h"
#include "haptic_server/session/device_table.h"
#include "tests/support/block.h"
#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::text_of;

/// A block 8 mm wide whose top face is z = 0, and a 2 mm burr above it that mills a cavity.
SessionScene block() {
    Scene scene;
    scene.name = "block";
    scene.burrs = {{.name = "2 mm", .diameter_mm = 2.0, .spindle_rev_per_s = 500.0}};
    scene.start_pose = {{0.0, 0.0, 2.5}, {0.0, 0.0, 1.0}};
    scene.trajectory = {
        .source = BuiltInTrajectory::cavity, .speed_mm_per_s = 8.0, .depth_mm = 0.8, .width_mm = 3.0};
    return {.scene = scene, .bone = testing::make_block({-4.0, -4.0, -3.2}, {4.0, 4.0, 0.0}, 0.1)};
}

SessionOptions virtual_options(double duration_s) {
    return {.milling = {.clock = ClockKind::virtual_time, .duration_s = duration_s}};
}

std::unique_ptr<SessionAssembly> simulated(SessionOptions options) {
    SessionScene scene = block();
    DeviceParts device = simulated_hand(scene.scene, Grip::firm);
    return std::make_unique<SessionAssembly>(std::move(scene), std::move(device), std::move(options));
}

class SessionAssemblyTest : public ::testing::Test {
  protected:
    SessionOptions logged(const std::string& name) const {
        SessionOptions options = virtual_options(1.5);
        options.logs = {.force = folder_ / (name + ".csv"), .milling = folder_ / (name + ".milling.csv")};
        return options;
    }
    testing::TemporaryFolder folder_;
    const std::atomic<bool> never_{false};
};

TEST_F(SessionAssemblyTest, IsTheSameToTheBitHoweverItsTicksAreDivided) {
    const auto whole = simulated(logged("whole"));
    whole->run(never_);
    const auto divided = simulated(logged("divided"));
    divided->start();
    std::uint64_t made = 0;
    for (std::uint64_t ticks = 1; const std::uint64_t now = divided->advance(ticks); ticks = ticks % 7 + 1)
        made += now;
    divided->end();
    EXPECT_EQ(made, 1501U);
    EXPECT_EQ(divided->advance(1), 0U) << "its duration is over";
    for (SessionAssembly* assembly : {whole.get(), divided.get()}) {
        assembly->logs().close_force();
        assembly->logs().close_milling();
    }
    EXPECT_EQ(divided->session().report().bone_checksum, whole->session().report().bone_checksum);
    EXPECT_GT(whole->session().report().removed_mm3[0], 0.1);
    EXPECT_EQ(text_of(folder_ / "divided.csv"), text_of(folder_ / "whole.csv"));
    EXPECT_EQ(text_of(folder_ / "divided.milling.csv"), text_of(folder_ / "whole.milling.csv"));
}

TEST_F(SessionAssemblyTest, RunsBesideOthersInItsProcessAsItDoesAlone) {
    const auto alone = simulated(virtual_options(0.8));
    alone->run(never_);
    std::vector<std::unique_ptr<SessionAssembly>> many;
    for (int i = 0; i < 4; ++i) many.push_back(simulated(virtual_options(0.8)));
    std::vector<std::thread> threads;
    for (const auto& assembly : many) threads.emplace_back([&] { assembly->run(never_); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& assembly : many) {
        EXPECT_EQ(assembly->session().report().bone_checksum, alone->session().report().bone_checksum);
        EXPECT_EQ(assembly->session().report().peak_force_n, alone->session().report().peak_force_n);
    }
}

TEST_F(SessionAssemblyTest, FollowsAHandThatIsPrescribedTickByTick) {
    SessionScene scene = block();
    scene.scene.device.offset_mm = {1.0, 2.0, 3.0};
    DeviceParts parts;
    parts.device = std::make_unique<PrescribedDevice>(scene.scene.start_pose, scene.scene.device);
    auto& hand = dynamic_cast<PrescribedDevice&>(*parts.device);
    SessionAssembly assembly(std::move(scene), std::move(parts), virtual_options(10.0));
    assembly.start();
    assembly.advance(10);
    hand.press(true);
    ToolPose pose = assembly.scene().start_pose;
    for (int tick = 0; tick < 2000; ++tick) {
        pose.position_mm.z = 2.5 - 0.001 * tick;
        hand.move_to(pose);
        ASSERT_EQ(assembly.advance(1), 1U);
    }
    assembly.end();
    EXPECT_GT(assembly.session().report().removed_mm3[0], 0.1);
    EXPECT_GT(assembly.session().report().peak_force_n, 0.0);
    assembly.session().exchange().tool.refresh();
    EXPECT_NEAR(assembly.session().exchange().tool.front().hand_position_mm.z, 0.501, 1e-9);
}

TEST_F(SessionAssemblyTest, IsRecordedFrameByFrameAlsoWhenItIsAdvanced) {
    const auto record = [&](const std::string& name) {
        SessionOptions options = virtual_options(1.5);
        options.shown.emplace();
        options.shown->streaming.listens = false;
        options.shown->streaming.record =
            RecordTo{folder_ / name, Stamp{std::chrono::seconds(1'700'000'000)}};
        return options;
    };
    const auto whole = simulated(record("whole.pcap"));
    whole->run(never_);
    const auto divided = simulated(record("divided.pcap"));
    divided->start();
    while (divided->advance(13) > 0) {
    }
    divided->end();
    for (SessionAssembly* assembly : {whole.get(), divided.get()}) {
        assembly->shown()->server().stop();
        EXPECT_EQ(assembly->shown()->server().mirror_checksum(), assembly->session().report().bone_checksum);
        ASSERT_TRUE(assembly->shown()->server().recording());
        EXPECT_EQ(assembly->shown()->server().recording()->error, "");
    }
    EXPECT_EQ(text_of(folder_ / "divided.pcap"), text_of(folder_ / "whole.pcap"));
}

TEST_F(SessionAssemblyTest, SeatsADeviceOnlyWhereTheSceneDoesNotSayHowItSits) {
    const auto offset_of = [](const DeviceMapping& of_scene, const std::optional<DeviceMapping>& of_device) {
        SessionScene scene = block();
        scene.scene.device = of_scene;
        DeviceParts parts = simulated_hand(scene.scene, Grip::firm);
        parts.home_mm = glm::dvec3(0.0, 0.0, 200.0);
        parts.mapping = of_device;
        return SessionAssembly(std::move(scene), std::move(parts), virtual_options(0.1))
            .scene()
            .device.offset_mm;
    };
    EXPECT_EQ(offset_of({}, {}), glm::dvec3(0.0, 0.0, -197.5));
    EXPECT_EQ(offset_of({.offset_mm = {1.0, 0.0, 0.0}}, {}), glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(offset_of({.offset_mm = {1.0, 0.0, 0.0}}, DeviceMapping{.offset_mm = {0.0, 5.0, 0.0}}),
              glm::dvec3(0.0, 5.0, 0.0));
}

TEST_F(SessionAssemblyTest, RefusesASessionOnTheVirtualClockThatNeverEnds) {
    SessionScene scene = block();
    scene.scene.trajectory.source = BuiltInTrajectory::hold;
    DeviceParts device = simulated_hand(scene.scene, Grip::firm);
    SessionOptions options{.milling = {.clock = ClockKind::virtual_time}};
    EXPECT_THROW(SessionAssembly(std::move(scene), std::move(device), std::move(options)),
                 std::runtime_error);
}

}  // namespace
}  // namespace osteomill
