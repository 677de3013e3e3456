#include "simulation/loop/milling_loop.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "analysis/logs/csv_log.h"
#include "simulation/force_models/milling_model.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

const Burr burr{.name = "2 mm", .diameter_mm = 2.0, .edges = 2};
const glm::dvec3 up(0.0, 0.0, 1.0);

/// A burr that the haptic loop's commands lead through a block at 6 mm/s, half a millimetre deep.
struct Rig {
    explicit Rig(const MillingSettings& settings = {})
        : model(testing::make_block({-3.0, -3.0, -2.0}, {3.0, 3.0, 0.0}, 0.1), {burr}, {}, settings) {}

    void command(double x_mm) {
        commands.back() = {.pose = {{x_mm, 0.03, 0.5}, up}, .spindle_on = true};
        commands.publish();
    }

    /// One command a millisecond, `steps_per_tick` steps for each.
    void run(int ticks, int steps_per_tick) {
        const double step_s = 0.001 / steps_per_tick;
        for (int tick = 0; tick < ticks; ++tick) {
            command(-2.0 + 0.006 * tick);
            for (int step = 0; step < steps_per_tick; ++step) {
                loop.step(0.001 * tick + step * step_s, step_s);
                if (!results->refresh()) continue;
                ++published;
                impulse_n_s += results->front().force_n * 0.001;
                removed_mm3 += results->front().removed_mm3;
                if (tick > 100) {
                    EXPECT_GT(results->front().engagement.count, 0u);
                }
            }
        }
    }

    MillingModel model;
    TripleBuffer<BurrCommand> commands;
    std::unique_ptr<TripleBuffer<MillingResult>> results = std::make_unique<TripleBuffer<MillingResult>>();
    ChangeQueue changes{1 << 20, model.bone().shared_content()};
    MillingLoop loop{{model, commands, *results, changes}, 0.001};
    int published = 0;
    glm::dvec3 impulse_n_s{0.0};
    double removed_mm3 = 0.0;
};

TEST(MillingLoop, BeyondTheHapticRateMillsTheSameAndReportsTheMeanOnceATick) {
    const auto once = std::make_unique<Rig>();
    once->run(400, 1);
    const auto tenfold = std::make_unique<Rig>();
    tenfold->run(400, 10);
    EXPECT_EQ(once->published, 400);
    EXPECT_EQ(tenfold->published, 400);
    EXPECT_EQ(checksum(tenfold->model.bone()), checksum(once->model.bone()));
    EXPECT_NEAR(tenfold->removed_mm3, once->removed_mm3, 1e-9);
    EXPECT_GT(glm::length(once->impulse_n_s), 0.01);
    EXPECT_LT(glm::length(tenfold->impulse_n_s - once->impulse_n_s), 0.01 * glm::length(once->impulse_n_s));
}

TEST(MillingLoop, StillReportsWhereCommandsStayAway) {
    const auto rig = std::make_unique<Rig>();
    rig->command(0.0);
    int published = 0;
    for (int step = 0; step < 1000; ++step) {
        rig->loop.step(0.0001 * step, 0.0001);
        published += rig->results->refresh() ? 1 : 0;
    }
    EXPECT_GT(published, 50);
}

TEST(MillingLoop, ShowsTheToothPeriodInItsLog) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "milling_loop_test.csv";
    const auto rig = std::make_unique<Rig>(MillingSettings{.summation = ForceSummation::instants});
    {
        MillingLog log(file);
        MillingLoop loop({rig->model, rig->commands, *rig->results, rig->changes, &log}, 0.001);
        for (int tick = 0; tick < 300; ++tick) {
            rig->command(-2.0 + 0.006 * tick);
            for (int step = 0; step < 10; ++step) loop.step(0.001 * tick + 0.0001 * step, 0.0001);
        }
        log.close();
        EXPECT_EQ(log.dropped(), 0u);
    }
    // 10 000 rpm and two edges: a tooth period is thirty steps, and the force repeats with it.
    std::ifstream lines(file);
    std::string line;
    std::getline(lines, line);
    std::vector<double> force_y_n;
    while (std::getline(lines, line)) {
        std::size_t at = 0;
        for (int comma = 0; comma < 5; ++comma) at = line.find(',', at) + 1;
        force_y_n.push_back(std::stod(line.substr(at)));
    }
    ASSERT_EQ(force_y_n.size(), 3000u);
    double swing = 0.0;
    double change = 0.0;
    for (std::size_t i = 2800; i < 2970; ++i) {
        swing = std::max(swing, std::abs(force_y_n[i + 15] - force_y_n[i]));
        change = std::max(change, std::abs(force_y_n[i + 30] - force_y_n[i]));
    }
    EXPECT_GT(swing, 5.0 * change);
    std::filesystem::remove(file);
}

TEST(MillingLoop, FindsRoomForAnotherBurrOnlyWhereNeitherTouchesBone) {
    const std::vector<Burr> burrs{burr, {.name = "5 mm", .diameter_mm = 5.0}};
    const auto rig = std::make_unique<Rig>();
    MillingLoop loop({.model = rig->model,
                      .commands = rig->commands,
                      .results = *rig->results,
                      .changes = rig->changes,
                      .burrs = burrs},
                     0.001);
    int step = 0;
    const auto room_mm = [&](double z_mm, std::optional<std::size_t> wanted, bool spindle_on = false) {
        // Twice: at the first the tool has just come there.
        for (int i = 0; i < 2; ++i) {
            rig->commands.back() = {
                .pose = {{0.031, 0.017, z_mm}, up}, .spindle_on = spindle_on, .wanted_burr = wanted};
            rig->commands.publish();
            loop.step(0.001 * step++, 0.001);
            rig->results->refresh();
        }
        return rig->results->front().room_for_change_mm;
    };
    EXPECT_GT(room_mm(10.0, 1), 0.05) << "in the air";
    EXPECT_GT(room_mm(2.8, 1), 0.05) << "just above";
    EXPECT_EQ(room_mm(2.4, 1), 0.0) << "the larger would touch";
    EXPECT_EQ(room_mm(1.0, 1), 0.0) << "both do";
    EXPECT_EQ(room_mm(10.0, std::nullopt), 0.0) << "nobody asks";
    EXPECT_EQ(room_mm(10.0, 7), 0.0) << "there is no such burr";
    EXPECT_EQ(room_mm(10.0, 1, true), 0.0) << "it turns";
    EXPECT_EQ(rig->results->front().wanted_burr, 1u);
}

TEST(MillingLoop, LooksAsFarAheadForAChangeAsTheToolMayGo) {
    const std::vector<Burr> burrs{burr, {.name = "3 mm", .diameter_mm = 3.0}};
    const auto rig = std::make_unique<Rig>();
    MillingLoop loop({.model = rig->model,
                      .commands = rig->commands,
                      .results = *rig->results,
                      .changes = rig->changes,
                      .burrs = burrs},
                     0.001);
    double z_mm = 5.0;
    for (int step = 0; step < 12; ++step, z_mm -= 0.3) {
        rig->commands.back() = {.pose = {{0.031, 0.017, z_mm}, up}, .wanted_burr = 1};
        rig->commands.publish();
        loop.step(0.001 * step, 0.001);
        rig->results->refresh();
        if (step == 0) continue;  // before, the tool was nowhere
        const double room_mm = rig->results->front().room_for_change_mm;
        const double above_bone_mm = z_mm - 1.5;
        if (above_bone_mm > 0.9) {
            EXPECT_NEAR(room_mm, 0.7, 1e-9) << z_mm;
        } else if (above_bone_mm < 0.6) {
            EXPECT_EQ(room_mm, 0.0) << z_mm;
        }
    }
}

TEST(MillingLoop, GivesBoneBackWhileTheSpindleIsOffAndTakesItOutOfTheAccount) {
    const auto rig = std::make_unique<Rig>();
    ChangeQueue restored{1 << 20, rig->model.bone().shared_content()};
    SessionGate gate;
    MillingLoop loop{{.model = rig->model,
                      .commands = rig->commands,
                      .results = *rig->results,
                      .changes = rig->changes,
                      .restored = &restored,
                      .gate = &gate},
                     0.001};
    const Bone whole = rig->model.bone();
    std::map<BrickIndex, VoxelMask> taken;
    int ticks = 0;
    const auto tick = [&](bool spindle_on) {
        rig->commands.back() = {.pose = {{-2.0 + 0.006 * ticks, 0.0, 0.5}, up}, .spindle_on = spindle_on};
        rig->commands.publish();
        loop.step(0.001 * ticks++, 0.001);
        rig->results->refresh();
    };
    for (int i = 0; i < 300; ++i) tick(true);
    ASSERT_GT(rig->results->front().total_removed_mm3, 0.1);
    rig->changes.consume_all([&](const BrickChange& change, BrickFractions) {
        taken[change.brick] |= change.voxels;
        EXPECT_EQ(change.kind, ChangeKind::milled);
    });
    for (const auto& [brick, voxels] : taken)
        ASSERT_TRUE(
            restored.try_push({brick, voxels, ChangeKind::restored}, whole.fractions(whole.slot(brick))));

    tick(true);
    EXPECT_EQ(gate.restored_changes, 0U) << "not while it turns";
    rig->changes.consume_all([](const BrickChange&, BrickFractions) {});
    EXPECT_EQ(rig->results->front().restored_changes, 0U);
    for (int i = 0; i < 100; ++i) tick(false);
    EXPECT_EQ(rig->results->front().restored_changes, taken.size()) << "also for a reader of this one alone";
    EXPECT_EQ(gate.restored_changes, taken.size());
    rig->changes.consume_all(
        [&](const BrickChange& change, BrickFractions) { EXPECT_EQ(change.kind, ChangeKind::restored); });
    // The last step of milling took more than was given back.
    EXPECT_LT(rig->results->front().total_removed_mm3, 1e-3);
    EXPECT_NEAR(rig->results->front().total_removed_mm3,
                bone_volume_mm3(whole) - bone_volume_mm3(rig->model.bone()), 1e-9);
}

}  // namespace
}  // namespace osteomill
