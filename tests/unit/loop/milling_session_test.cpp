#include "simulation/loop/milling_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <thread>

#include "devices/simulated/simulated_device.h"
#include "simulation/force_models/force_models.h"
#include "simulation/loop/real_time.h"
#include "tests/support/block.h"
#include "tests/unit/loop/scripted_parts.h"

namespace osteomill {
namespace {

/// A block 8 mm wide whose top face is z = 0, and a 2 mm burr above it.
Bone block() {
    return testing::make_block({-4.0, -4.0, -3.2}, {4.0, 4.0, 0.0}, 0.1);
}

Scene block_scene() {
    Scene scene;
    scene.name = "block";
    scene.burrs = {{.name = "2 mm", .diameter_mm = 2.0, .spindle_rev_per_s = 500.0}};
    scene.start_pose = {{0.0, 0.0, 2.5}, {0.0, 0.0, 1.0}};
    scene.trajectory = {
        .source = BuiltInTrajectory::cavity, .speed_mm_per_s = 8.0, .depth_mm = 0.8, .width_mm = 3.0};
    return scene;
}

SimulatedDevice simulated(const Scene& scene) {
    return SimulatedDevice(make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, 0), scene.device,
                           ArmModel{}, hand_model(Grip::firm));
}

// GCC's names for them, then clang's.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitiser_ignores_locks = true;
#elif defined(__has_feature)
constexpr bool sanitiser_ignores_locks = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool sanitiser_ignores_locks = false;
#endif

MillingSessionOptions virtual_options(double duration_s) {
    return {.clock = ClockKind::virtual_time, .duration_s = duration_s};
}

MillingSessionReport run(const MillingSessionOptions& options) {
    const Scene scene = block_scene();
    SimulatedDevice device = simulated(scene);
    const auto session = std::make_unique<MillingSession>(scene, block(), device, options);
    const std::atomic<bool> never{false};
    session->run(never);
    return session->report();
}

TEST(MillingSession, MillsOnTheVirtualClock) {
    const MillingSessionReport report = run(virtual_options(4.0));
    EXPECT_EQ(report.haptic.ticks, 4001u);
    EXPECT_EQ(report.milling.ticks, 4001u);
    EXPECT_GT(report.removed_mm3[0], 0.5);
    EXPECT_GT(report.peak_force_n, 0.05);
    EXPECT_LE(report.peak_force_n, 3.3);
    EXPECT_NE(report.bone_checksum, checksum(block()));
    for (const std::uint64_t count : report.fault_counts) EXPECT_EQ(count, 0u);
}

TEST(MillingSession, ACopyGoesOnToTheBit) {
    for (const char* coupling : {"implicit", "sample-estimate-interpolate+passivity", "virtual-coupling"}) {
        for (const bool shares_bone : {false, true}) {
            const Scene scene = block_scene();
            SimulatedDevice device = simulated(scene);
            MillingSessionOptions options = virtual_options(4.0);
            options.coupling = coupling_named(coupling);
            options.vibration = true;
            Bone bone = block();
            if (shares_bone) bone.share();
            MillingSession session(scene, std::move(bone), device, options);
            session.start();
            session.advance(1200);
            const std::uint64_t at_copy = checksum(session.bone());
            EXPECT_NE(at_copy, checksum(block())) << coupling;

            SimulatedDevice other_device = device;
            MillingSession copy(session, other_device);
            copy.advance(800);
            EXPECT_EQ(checksum(session.bone()), at_copy) << "the copy's bone is its own";
            session.advance(800);
            EXPECT_NE(checksum(session.bone()), at_copy);
            EXPECT_EQ(checksum(copy.bone()), checksum(session.bone())) << coupling;
            EXPECT_EQ(copy.newest_state().hand_position_mm, session.newest_state().hand_position_mm)
                << coupling;
            EXPECT_EQ(copy.newest_state().burr_position_mm, session.newest_state().burr_position_mm)
                << coupling;
            EXPECT_EQ(copy.newest_state().force_n, session.newest_state().force_n) << coupling;
            EXPECT_EQ(copy.known_result().force_n, session.known_result().force_n) << coupling;
            EXPECT_EQ(copy.removed_mm3(0), session.removed_mm3(0));
        }
    }
}

TEST(MillingSession, OneOfTheRealClockIsNotCopied) {
    const Scene scene = block_scene();
    SimulatedDevice device = simulated(scene);
    const MillingSession session(scene, block(), device, {});
    EXPECT_THROW(MillingSession(session, device), std::invalid_argument);
}

TEST(MillingSession, MillsWithEveryForceModel) {
    for (const ForceModelEntry& model : force_models()) {
        MillingSessionOptions options = virtual_options(3.0);
        options.force_model = model.name;
        if (!model.has_cutting_law) options.coupling = {CouplingKind::interpolate};
        const MillingSessionReport report = run(options);
        EXPECT_GT(report.removed_mm3[0], 0.3) << model.name;
        EXPECT_GT(report.peak_force_n, 0.02) << model.name;
        EXPECT_LE(report.peak_force_n, 3.3) << model.name;
        for (const std::uint64_t count : report.fault_counts) EXPECT_EQ(count, 0u) << model.name;
    }
}

/// With an arm that reads exactly: whole steps of an encoder are energy that the hand neither got nor gave.
MillingSessionReport run_on_exact_arm(Grip grip, bool vibration) {
    Scene scene = block_scene();
    scene.burrs[0].spindle_rev_per_s = 10'000.0 / 60.0;
    SimulatedDevice device(make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, 0), scene.device,
                           ArmModel{.resolution_mm = 0.0}, hand_model(grip));
    MillingSessionOptions options = virtual_options(4.0);
    options.vibration = vibration;
    const auto session = std::make_unique<MillingSession>(scene, block(), device, options);
    const std::atomic<bool> never{false};
    session->run(never);
    return session->report();
}

TEST(MillingSession, GivesAHandNoMoreEnergyWithVibration) {
    for (const Grip grip : {Grip::light, Grip::firm}) {
        const MillingSessionReport without = run_on_exact_arm(grip, false);
        const MillingSessionReport with = run_on_exact_arm(grip, true);
        EXPECT_NE(with.bone_checksum, without.bone_checksum) << "it shakes";
        EXPECT_LE(with.most_energy_to_hand_mj, without.most_energy_to_hand_mj + 1e-6);
        EXPECT_LE(with.peak_force_n, 3.3);
        for (const std::uint64_t count : with.fault_counts) EXPECT_EQ(count, 0u);
    }
}

TEST(MillingSession, IsPushedOutOfBoneByEveryModelThatHoldsTheWall) {
    for (const ForceModelEntry& model : force_models()) {
        if (model.has_cutting_law) continue;
        testing::ScriptedDevice device;  // presses into the top face, the pedal up
        device.script = [](double t_s) {
            return DeviceState{.position_mm = {0.0, 0.0, 1.0 - std::min(0.3, t_s)}};
        };
        MillingSessionOptions options = virtual_options(0.5);
        options.force_model = model.name;
        options.coupling = {CouplingKind::interpolate};
        const auto session = std::make_unique<MillingSession>(block_scene(), block(), device, options);
        const std::atomic<bool> never{false};
        session->run(never);
        EXPECT_GT(device.written_n.back().z, 0.1) << model.name;
        EXPECT_EQ(session->report().bone_checksum, checksum(block())) << model.name;
    }
}

TEST(MillingSession, RefusesToSolveACuttingLawThatAForceModelHasNot) {
    testing::ScriptedDevice device;
    MillingSessionOptions options = virtual_options(1.0);
    options.force_model = "agus";
    options.coupling = {CouplingKind::implicit};
    EXPECT_THROW(MillingSession(block_scene(), block(), device, options), std::invalid_argument);
}

TEST(MillingSession, IsTheSameToTheBitEachTime) {
    const MillingSessionReport first = run(virtual_options(3.0));
    const MillingSessionReport second = run(virtual_options(3.0));
    EXPECT_EQ(first.bone_checksum, second.bone_checksum);
    EXPECT_EQ(first.removed_mm3, second.removed_mm3);
    EXPECT_EQ(first.peak_force_n, second.peak_force_n);
}

TEST(MillingSession, AtAChosenSpeedIsTheSameAsWithABurrOfThatSpeed) {
    const auto milled = [](double own_rpm, std::uint32_t chosen_rpm) {
        Scene scene = block_scene();
        scene.burrs[0].spindle_rev_per_s = own_rpm / 60.0;
        SimulatedDevice device = simulated(scene);
        MillingSessionOptions options = virtual_options(2.0);
        options.can_be_controlled = true;
        const auto session = std::make_unique<MillingSession>(scene, block(), device, options);
        session->exchange().gate.spindle_rpm = chosen_rpm;
        const std::atomic<bool> never{false};
        session->run(never);
        return session->report();
    };
    const MillingSessionReport slow = milled(15'000.0, 0);
    const MillingSessionReport chosen = milled(15'000.0, 30'000);
    const MillingSessionReport fast = milled(30'000.0, 0);
    EXPECT_EQ(chosen.bone_checksum, fast.bone_checksum);
    EXPECT_EQ(chosen.peak_force_n, fast.peak_force_n);
    EXPECT_NE(chosen.bone_checksum, slow.bone_checksum);
}

TEST(MillingSession, StepsTheModelAtItsRateEvenWhereThatDoesNotDivideTheTicks) {
    for (const double rate_hz : {100.0, 300.0, 770.0, 1000.0, 2500.0, 10'000.0}) {
        MillingSessionOptions options = virtual_options(1.0);
        options.milling_rate_hz = rate_hz;
        EXPECT_EQ(run(options).milling.ticks, static_cast<std::uint64_t>(rate_hz) + 1) << rate_hz << " Hz";
    }
}

void follow(ChangeQueue& changes, Bone& copy) {
    changes.consume_all([&](const BrickChange& change, BrickFractions fractions) {
        EXPECT_TRUE(apply(change, fractions, copy));
    });
}

TEST(MillingSession, TellsWhoeverCopiesTheBoneEveryChange) {
    const Scene scene = block_scene();
    SimulatedDevice device = simulated(scene);
    MillingSessionOptions options = virtual_options(3.0);
    options.changes_are_consumed = true;
    const auto session = std::make_unique<MillingSession>(scene, block(), device, options);
    Bone copy = block();
    std::atomic<bool> done{false};
    std::thread consumer([&] {
        for (bool last_round = false; !last_round;) {
            last_round = done.load();
            follow(session->exchange().changes, copy);
            std::this_thread::yield();
        }
    });
    const std::atomic<bool> never{false};
    session->run(never);
    done.store(true);
    consumer.join();
    EXPECT_EQ(checksum(copy), session->report().bone_checksum);
}

TEST(MillingSession, RunsInThreadsOnTheRealClockAndStopsWhenTold) {
    const Scene scene = block_scene();
    SimulatedDevice device = simulated(scene);
    MillingSessionOptions options;
    options.changes_are_consumed = true;
    const auto session = std::make_unique<MillingSession>(scene, block(), device, options);
    Bone copy = block();
    std::atomic<bool> done{false};
    std::uint64_t shown = 0;
    std::thread streaming([&] {  // the work of the streaming loop
        for (bool last_round = false; !last_round;) {
            last_round = done.load();
            follow(session->exchange().changes, copy);
            shown += session->exchange().tool.refresh() ? 1 : 0;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    });
    std::atomic<bool> stop{false};
    session->run(stop, [&](const ToolState& tool) {
        // On a busy machine the monitor may stop the spindle, for good, before anything is cut.
        if (tool.removed_mm3 > 0.01 || tool.time_s > 20.0) stop.store(true);
    });
    done.store(true);
    streaming.join();
    const MillingSessionReport report = session->report();
    EXPECT_GT(report.haptic.ticks, 100u);
    EXPECT_GT(report.milling.ticks, 100u);
    EXPECT_EQ(report.haptic.wakeup_latency.count(), report.haptic.ticks);
    EXPECT_GT(shown, 0u);
    EXPECT_EQ(checksum(copy), report.bone_checksum);
}

TEST(MillingSession, WaitsForNoPageOnceItsMemoryIsLocked) {
    const MillingSessionReport report = run({.duration_s = 0.6});
    if (!report.memory_locked) GTEST_SKIP() << "this user may not lock memory";
    if (sanitiser_ignores_locks) GTEST_SKIP() << "a sanitizer takes mlockall for done";
    EXPECT_GT(report.haptic.ticks, MillingSession::settling_ticks) << "it was counted";
    EXPECT_EQ(report.haptic_page_faults, 0u);
    EXPECT_EQ(report.milling_page_faults, 0u);
}

TEST(MillingSession, BindsItsLoopsToProcessorsThatThereAre) {
    const int cpu = usable_cpus().front();
    EXPECT_GT(run({.duration_s = 0.05, .haptic_cpu = cpu, .milling_cpu = cpu}).haptic.ticks, 0u);
    try {
        run({.duration_s = 0.05, .haptic_cpu = 1000});
        FAIL() << "there is no such processor";
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("processor 1000"));
    }
}

TEST(MillingSession, StartsAndStopsItsDeviceOnce) {
    testing::ScriptedDevice device;
    const auto session =
        std::make_unique<MillingSession>(block_scene(), block(), device, virtual_options(0.05));
    const std::atomic<bool> never{false};
    session->run(never);
    EXPECT_EQ(device.started, 1);
    EXPECT_EQ(device.stopped, 1);
    EXPECT_EQ(device.written_n.size(), 51u);
}

TEST(MillingSession, DoesNotCutWithThePedalUp) {
    testing::ScriptedDevice device;  // in the middle of the block from the first tick on
    device.script = [](double t_s) { return DeviceState{.position_mm = {t_s, 0.0, -0.5}}; };
    const auto session =
        std::make_unique<MillingSession>(block_scene(), block(), device, virtual_options(0.5));
    const std::atomic<bool> never{false};
    session->run(never);
    EXPECT_EQ(session->report().bone_checksum, checksum(block()));
}

TEST(MillingSession, ShowsTheStartPoseBeforeTheFirstTick) {
    testing::ScriptedDevice device;
    Scene scene = block_scene();
    scene.start_pose = {{1.0, 2.0, 3.0}, {0.0, 0.6, 0.8}};
    scene.burrs.push_back(scene.burrs.front());
    scene.start_burr = 1;
    const auto session = std::make_unique<MillingSession>(scene, block(), device, virtual_options(0.5));
    EXPECT_FALSE(session->exchange().tool.refresh());
    const ToolState& tool = session->exchange().tool.front();
    EXPECT_EQ(tool.burr_position_mm, scene.start_pose.position_mm);
    EXPECT_EQ(tool.spindle_axis, scene.start_pose.spindle_axis);
    EXPECT_EQ(tool.hand_position_mm, scene.start_pose.position_mm);
    EXPECT_EQ(tool.burr, 1U);
}

TEST(MillingSession, StartsInsideTheBoneWithoutForceOrSpindle) {
    testing::ScriptedDevice device;
    device.script = [](double) { return DeviceState{.position_mm = {0.0, 0.0, 0.5}, .pedal = {true}}; };
    const auto session =
        std::make_unique<MillingSession>(block_scene(), block(), device, virtual_options(0.5));
    session->run(std::atomic<bool>{false});
    EXPECT_EQ(session->report().bone_checksum, checksum(block()));
    EXPECT_EQ(session->report().peak_force_n, 0.0);
    EXPECT_EQ(session->report().fault_counts[static_cast<std::size_t>(Fault::in_bone)], 1U);
}

TEST(MillingSession, CutsNoChannelToWhereADeviceJumped) {
    testing::ScriptedDevice device;
    device.script = [](double t_s) {
        return DeviceState{.position_mm = {t_s < 0.1 ? -3.0 : 3.0, 0.0, std::max(0.5, 2.0 - 30.0 * t_s)},
                           .pedal = {true}};
    };
    const auto session =
        std::make_unique<MillingSession>(block_scene(), block(), device, virtual_options(1.0));
    const std::atomic<bool> never{false};
    session->run(never);
    const Bone& bone = session->bone();
    const auto middle = glm::ivec3(to_voxel_coordinates(bone.grid(), {0.0, 0.0, -0.05}) + 0.5);
    EXPECT_EQ(bone.fraction_at(middle), 255);
    EXPECT_EQ(session->report().fault_counts[static_cast<std::size_t>(Fault::device_jumped)], 1u);
}

TEST(MillingSession, RefusesMillingRatesThatItsWatchdogWouldNotBear) {
    testing::ScriptedDevice device;
    for (const double rate_hz : {0.0, 10.0, 10'001.0, static_cast<double>(NAN)}) {
        MillingSessionOptions options = virtual_options(1.0);
        options.milling_rate_hz = rate_hz;
        EXPECT_THROW(MillingSession(block_scene(), block(), device, options), std::invalid_argument);
    }
}

}  // namespace
}  // namespace osteomill
