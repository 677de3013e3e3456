// Real-time code does not allocate: this program counts every call of operator new.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "analysis/logs/csv_log.h"
#include "devices/client/client_device.h"
#include "devices/haply/haply_arm.h"
#include "devices/simulated/simulated_device.h"
#include "devices/tracker/sampled_motion.h"
#include "simulation/coupling/couplings.h"
#include "simulation/coupling/handpiece_vibration.h"
#include "simulation/force_models/force_models.h"
#include "simulation/loop/haptic_loop.h"
#include "simulation/loop/milling_loop.h"
#include "tests/support/ball_structure.h"
#include "tests/support/block.h"
#include "tests/support/eventually.h"
#include "tests/support/haply_service.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/loop/counting_new.h"

namespace osteomill {
namespace {

const Burr burr{.name = "2 mm", .diameter_mm = 2.0, .shank = {{1.2, 0.7}, {10.0, 0.7}}};
/// In the air above the block.
const ToolPose start{{-3.0, 0.0, 1.1}, {0.0, 0.0, 1.0}};

/// Slides through a block with the spindle on: the loops are in the middle of their work.
struct Rig {
    Rig(const std::string& force_model, const std::string& coupling_name, HapticDevice& device,
        const Burr& used, const std::shared_ptr<const Fixtures>& fixtures)
        : model(make_force_model(force_model, testing::make_block({-4.0, -4.0, -3.2}, {4.0, 4.0, 0.0}, 0.1),
                                 {used}, {})),
          coupling(
              make_coupling(coupling_named(coupling_name),
                            {.device = in_patient_space(device.limits(), ArmScale()),
                             .milling_period_s = 0.001,
                             .model_holds_wall = !osteomill::find_force_model(force_model).has_cutting_law,
                             .feed_forward = true,
                             .fixtures = fixtures})),
          vibration({used}, {.max_force_n = 3.3, .max_slew_n_per_s = ForceGuard::slew_n_per_s}),
          haptic({device, *coupling, *results, commands, tool, status, &log, &vibration, &gate},
                 {.spindle_rev_per_s = {used.spindle_rev_per_s},
                  .has_shank = true,
                  .has_fixtures = fixtures != nullptr,
                  .fixtures_on = 0b111,
                  .start_pose = start}) {}

    testing::TemporaryFolder folder;
    ForceLog log{folder / "forces.csv"};
    MillingLog milling_log{folder / "milling.csv"};
    std::unique_ptr<ForceModel> model;
    std::unique_ptr<TripleBuffer<MillingResult>> results = std::make_unique<TripleBuffer<MillingResult>>();
    TripleBuffer<BurrCommand> commands;
    TripleBuffer<ToolState> tool;
    TripleBuffer<ToolState> status;
    SessionGate gate;
    ChangeQueue changes{1 << 12, model->bone().shared_content()};  // small: it overflows, too
    std::unique_ptr<Coupling> coupling;
    HandpieceVibration vibration;
    HapticLoop haptic;
    MillingLoop milling{{*model, commands, *results, changes, &milling_log}, 0.001};
};

/// Returns in how many ticks the shank touched bone.
int expect_no_allocation(
    const std::string& force_model, const std::string& coupling_name, HapticDevice& device,
    const std::function<void()>& before_tick = [] {}, const Burr& used = burr,
    const std::shared_ptr<const Fixtures>& fixtures = nullptr) {
    const auto rig = std::make_unique<Rig>(force_model, coupling_name, device, used, fixtures);
    int touching = 0;
    FixtureSet ever_on = 0;
    FixtureSet always_on = every_fixture;
    const std::size_t before = testing::allocation_count();
    for (int tick = 0; tick < 2000; ++tick) {
        const double time_s = 0.001 * tick;
        before_tick();
        rig->gate.fixtures_on = tick < 1750 ? 0b111 : 0b101;
        rig->haptic.tick(time_s, tick >= 1000 && tick % 500 == 499 ? 30 : 0);  // faults are no excuse
        rig->milling.step(time_s, 0.001);
        rig->tool.refresh();
        touching += rig->tool.front().shank_torque_n_mm != glm::dvec3(0.0);
        ever_on |= rig->tool.front().fixtures_on;
        always_on &= rig->tool.front().fixtures_on;
    }
    EXPECT_EQ(testing::allocation_count() - before, 0u) << force_model << ", " << coupling_name;
    EXPECT_GT(rig->model->removed_mm3()[0], 0.1) << "there was something to do";
    // The force is off by then: a burr that is in bone after a fault stays out of it.
    EXPECT_EQ(ever_on & ~always_on, fixtures ? 0b010U : 0U) << "one was switched";
    EXPECT_GT(rig->changes.overflow_count(), 0u) << force_model << ", " << coupling_name;
    return touching;
}

TEST(RealTimeCode, AllocatesNothingWithAHeadThatIsNoBallAndTilts) {
    Burr pear = burr;
    pear.head = usual_head(HeadShape::pear, 2.0, 3.0);
    pear.edge_coefficients_n_per_mm = {0.02, 0.02, 0.0};
    for (const char* model : {"milling", "milling-instants"}) {
        SimulatedDevice device(Trajectory({{0.0, start, true, std::nullopt},
                                           {0.15, {{-2.7, 0.0, 0.4}, {0.0, 0.0, 1.0}}, true, std::nullopt},
                                           {1.5, {{1.5, 0.0, 0.25}, {0.6, 0.0, 0.8}}, false, std::nullopt},
                                           {2.0, {{3.0, 0.0, 0.2}, {0.0, 0.6, 0.8}}, false, std::nullopt}}),
                               DeviceMapping{}, ArmModel{}, hand_model(Grip::firm));
        expect_no_allocation(
            model, "implicit", device, [] {}, pear);
    }
}

TEST(RealTimeCode, AllocatesNothingWithASimulatedHand) {
    // Every model under the default coupling or its replacement, every coupling on the default model.
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const ForceModelEntry& model : force_models())
        pairs.emplace_back(model.name, model.has_cutting_law ? "implicit" : "interpolate");
    for (const CouplingEntry& coupling : couplings())
        pairs.emplace_back(force_model_names().front(), coupling.name);
    for (const auto& [model, coupling] : pairs) {
        SimulatedDevice device(Trajectory({{0.0, start, true, std::nullopt},
                                           {0.15, {{-2.7, 0.0, 0.4}, {0.0, 0.0, 1.0}}, true, std::nullopt},
                                           {1.5, {{1.5, 0.0, 0.25}, {0.0, 0.0, 1.0}}, false, std::nullopt},
                                           {2.0, {{3.0, 0.0, 0.2}, {0.0, 0.0, 1.0}}, false, std::nullopt}}),
                               DeviceMapping{}, ArmModel{}, hand_model(Grip::firm));
        expect_no_allocation(model, coupling, device);
    }
}

TEST(RealTimeCode, AllocatesNothingWithFixtures) {
    Scene scene;
    scene.burrs = {burr};
    scene.tissues = {{.label = 1, .name = "nerve", .is_protected = true}};
    for (const FixtureKind kind : {FixtureKind::guide, FixtureKind::forbidden, FixtureKind::slow}) {
        scene.fixtures.push_back(usual_fixture(kind));
        scene.fixtures.back().tissue = "nerve";
    }
    scene.fixtures[0].path = LineGuide{{-3.0, 0.2, 0.3}, {3.0, 0.2, 0.3}};
    scene.fixtures[2].spindle_share = 0.5;
    const Grid grid{.size_voxels = {16, 16, 16}, .spacing_mm = 0.1, .origin_mm = {-0.75, -0.75, -2.0}};
    const std::vector<Structure> nerve{
        {.tissue = 0, .mask = testing::ball_mask(grid, {0.0, 0.0, -1.2}, 0.5)}};
    const auto fixtures = make_fixtures(scene, nerve, 1.5);
    ASSERT_NE(fixtures->at({{0.0, 0.0, 0.25}, {0.0, 0.0, 1.0}}, 0).pull.force_n, glm::dvec3(0.0));
    for (const char* coupling : {"implicit", "virtual-coupling"}) {
        SimulatedDevice device(Trajectory({{0.0, start, true, std::nullopt},
                                           {0.15, {{-2.7, 0.0, 0.4}, {0.0, 0.0, 1.0}}, true, std::nullopt},
                                           {1.5, {{1.5, 0.0, 0.25}, {0.0, 0.0, 1.0}}, false, std::nullopt},
                                           {2.0, {{3.0, 0.0, 0.2}, {0.0, 0.0, 1.0}}, false, std::nullopt}}),
                               DeviceMapping{}, ArmModel{}, hand_model(Grip::firm));
        expect_no_allocation(
            force_model_names().front(), coupling, device, [] {}, burr, fixtures);
    }
}

TEST(RealTimeCode, AllocatesNothingWithAShankThatTouches) {
    // Along the block with the spindle lying down: the shank leans on bone that the burr has yet to reach.
    const glm::dvec3 ahead(1.0, 0.0, 0.0);
    SimulatedDevice device(Trajectory({{0.0, {{-3.0, 0.0, 1.1}, ahead}, true, std::nullopt},
                                       {0.15, {{-2.7, 0.0, -0.1}, ahead}, true, std::nullopt},
                                       {1.5, {{1.5, 0.0, -0.3}, ahead}, false, std::nullopt},
                                       {2.0, {{3.0, 0.0, -0.3}, ahead}, false, std::nullopt}}),
                           DeviceMapping{}, ArmModel{}, hand_model(Grip::firm));
    EXPECT_GT(expect_no_allocation(force_model_names().front(), "implicit", device), 100);
}

TEST(RealTimeCode, AllocatesNothingWithAnOperator) {
    OperatorChannel input;
    ClientDevice device(input, start, DeviceMapping{}, ArmModel{}, hand_model(Grip::firm));
    // An operator's command is valid for a fifth of a second only; the pedal is up at first.
    bool pedal = false;
    const auto say_again = [&input, &pedal] {
        input.back() = {.command = OperatorCommand{.hand_target_mm = {2.0, 0.0, 0.2},
                                                   .pedal = std::exchange(pedal, true)},
                        .heard = std::chrono::steady_clock::now()};
        input.publish();
    };
    expect_no_allocation(force_model_names().front(), "implicit", device, say_again);
}

TEST(RealTimeCode, AllocatesNothingWhileItPlaysATrackersSamples) {
    SampledMotion motion;
    int played = 0;
    const std::size_t before = testing::allocation_count();
    for (int tick = 0; tick < 5000; ++tick) {
        const double now_s = 0.001 * tick;
        if (tick % 7 == 0 && tick % 1000 < 800)  // a silence in each second
            motion.take({.stamp_s = 5.0 + now_s, .arrival_s = now_s, .position_mm = {now_s, 0.0, 0.0}});
        if (motion.at(now_s)) ++played;
    }
    EXPECT_EQ(testing::allocation_count(), before);
    EXPECT_GT(played, 3500);
}

// Its thread does, for messages.
TEST(RealTimeCode, AllocatesNothingBetweenTheLoopAndHaplysService) {
    testing::HaplyService service;
    HaplyArm arm(HaplyArm::Parts{.service = {.port = service.port()}});
    ASSERT_TRUE(arm.await(testing::far_too_late()));
    int taken = 0;
    const std::size_t before = testing::allocation_count_here();
    for (int tick = 0; taken < 200; ++tick) {
        const DeviceState state = arm.read(0.001 * tick);
        if (state.connected) ++taken;
        arm.write({0.01 * (tick % 10), 0.0, 0.0});
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_EQ(testing::allocation_count_here(), before);
    EXPECT_GT(service.largest_force_n(), 0.0) << "there was something to do";
}

TEST(RealTimeCode, WouldBeCaughtAllocating) {
    const std::size_t before = testing::allocation_count();
    const auto something = std::make_unique<int>(1);
    EXPECT_GT(testing::allocation_count(), before);
    EXPECT_EQ(*something, 1);
}

}  // namespace
}  // namespace osteomill
