#include "simulation/loop/haptic_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "analysis/logs/csv_log.h"
#include "tests/unit/loop/scripted_parts.h"

namespace osteomill {
namespace {

using testing::tick_s;

/// A haptic loop between a scripted device, a scripted coupling and a milling loop that the test plays.
class Bench {
  public:
    testing::ScriptedDevice device;
    testing::ForcefulCoupling coupling;
    std::unique_ptr<TripleBuffer<MillingResult>> results = std::make_unique<TripleBuffer<MillingResult>>();
    TripleBuffer<BurrCommand> commands;
    TripleBuffer<ToolState> tool;
    TripleBuffer<ToolState> status;
    HapticLoopOptions options{.burr_count = 3, .start_burr = 1};
    MillingResult next;  // the milling loop's result from now on
    HandpieceVibration* vibration = nullptr;
    SessionGate gate;
    TripleBuffer<Placement> placements;
    bool model_runs = true;
    std::uint64_t tick_number = 0;

    /// Runs ticks; returns the last force written, device space.
    glm::dvec3 run(int ticks, std::uint64_t missed = 0) {
        if (!loop_) {
            loop_ =
                std::make_unique<HapticLoop>(HapticLoopParts{device, coupling, *results, commands, tool,
                                                             status, nullptr, vibration, &gate, &placements},
                                             options);
        }
        for (int i = 0; i < ticks; ++i) {
            if (model_runs) {
                ++next.step;
                next.pose = commands.front().pose;
                next.burr = commands.front().burr;
                next.wanted_burr = commands.front().wanted_burr;
                results->back() = next;
                results->publish();
            }
            tick_number += missed;
            loop_->tick(tick_s * static_cast<double>(tick_number++), missed);
            commands.refresh();
            tool.refresh();
        }
        return device.written_n.back();
    }
    void settle(double total_removed_mm3) {
        loop_->settle(total_removed_mm3, 0);
        tool.refresh();
    }
    const BurrCommand& command() const { return commands.front(); }
    const ToolState& shown() const { return tool.front(); }
    HapticLoop& loop() const { return *loop_; }

    /// A pedal that is down, a hand at rest, a steady 2 N.
    void mill() {
        device.script = [](double) { return DeviceState{.pedal = {true}}; };
        coupling.force = [](const HandState&) { return glm::dvec3(2.0, 0.0, 0.0); };
        run(20);
    }

  private:
    std::unique_ptr<HapticLoop> loop_;
};

int ticks_to_fade() {
    return static_cast<int>(ForceGuard::fade_out_s / tick_s) + 2;
}

TEST(HapticLoop, WritesWhatTheCouplingWantsAndTellsTheOthers) {
    Bench bench;
    bench.next.total_removed_mm3 = 1.25;
    bench.mill();
    EXPECT_EQ(bench.run(1), glm::dvec3(2.0, 0.0, 0.0));
    EXPECT_EQ(bench.shown().force_n, glm::dvec3(2.0, 0.0, 0.0));
    EXPECT_EQ(bench.shown().removed_mm3, 1.25);
    bench.settle(1.5);
    EXPECT_EQ(bench.shown().removed_mm3, 1.5) << "its own millisecond's";
    EXPECT_TRUE(bench.shown().spindle_on);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    EXPECT_TRUE(bench.command().spindle_on);
    EXPECT_EQ(bench.command().burr, 1u);
    EXPECT_EQ(bench.loop().peak_force_n(), 2.0);
}

TEST(HapticLoop, MapsTheHandToThePatientAndTheForceBack) {
    Bench bench;
    bench.options.mapping = {
        .rotation = glm::dmat3({0, 1, 0}, {-1, 0, 0}, {0, 0, 1}), .scale = 2.0, .offset_mm = {1.0, 0.0, 0.0}};
    bench.device.script = [](double) {
        return DeviceState{
            .position_mm = {3, 0, 0}, .velocity_mm_per_s = {5, 0, 0}, .spindle_axis = {1, 0, 0}};
    };
    bench.coupling.force = [](const HandState&) { return glm::dvec3(0.0, 0.5, 0.0); };
    // In the first tick nothing is known of the bone at the hand.
    EXPECT_EQ(bench.run(1), glm::dvec3(0.0));
    const glm::dvec3 written = bench.run(1);
    const HandState& hand = bench.coupling.hands.back();
    EXPECT_EQ(hand.pose.position_mm, glm::dvec3(1.0, 6.0, 0.0));
    EXPECT_EQ(hand.velocity_mm_per_s, glm::dvec3(0.0, 10.0, 0.0));
    EXPECT_EQ(hand.pose.spindle_axis, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(written, glm::dvec3(0.5, 0.0, 0.0)) << "turned back, not scaled";
    EXPECT_EQ(bench.shown().force_n, glm::dvec3(0.0, 0.5, 0.0));
}

TEST(HapticLoop, TellsTheCouplingHowLongTheTickReallyWas) {
    Bench bench;
    bench.run(1);
    bench.run(1, 3);
    EXPECT_DOUBLE_EQ(bench.coupling.hands.back().tick_s, 0.004);
}

TEST(HapticLoop, ChangesTheBurrToOneOfTheSetOnly) {
    Bench bench;
    bench.next.room_for_change_mm = 1.0;
    bench.device.script = [](double) { return DeviceState{.burr = 2}; };
    bench.run(2);
    EXPECT_EQ(bench.command().burr, 2u);
    bench.device.script = [](double) { return DeviceState{.burr = 3}; };
    bench.run(2);
    EXPECT_EQ(bench.command().burr, 2u);
}

TEST(HapticLoop, ChangesNoBurrThatTurnsOrTouchesBoneAndSaysWhy) {
    Bench bench;
    bool pedal = true;
    bench.device.script = [&](double) { return DeviceState{.pedal = {pedal}, .burr = 2}; };
    bench.next.room_for_change_mm = 1.0;
    bench.run(20);
    EXPECT_EQ(bench.command().burr, 1u);
    EXPECT_EQ(bench.shown().notice, describe(BurrChange::spindle));
    pedal = false;
    bench.next.room_for_change_mm = 0.0;
    bench.run(20);
    EXPECT_EQ(bench.command().burr, 1u);
    EXPECT_EQ(bench.command().wanted_burr, 2u);
    EXPECT_EQ(bench.shown().notice, describe(BurrChange::bone));
    bench.next.room_for_change_mm = 1.0;
    bench.run(2);
    EXPECT_EQ(bench.command().burr, 2u);
    EXPECT_EQ(bench.shown().burr, 2u);
    EXPECT_EQ(bench.shown().notice, describe(BurrChange::none));
}

TEST(HapticLoop, KeepsTheSpindleOffWithoutThePedal) {
    Bench bench;
    bench.run(5);
    EXPECT_FALSE(bench.command().spindle_on);
}

TEST(HapticLoop, FadesOutAndStopsTheSpindleWhenTheModelStalls) {
    Bench bench;
    bench.mill();
    bench.model_runs = false;
    bench.run(50);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    bench.run(ticks_to_fade());
    EXPECT_EQ(bench.shown().force_n, glm::dvec3(0.0));
    EXPECT_EQ(bench.shown().fault, describe(Fault::model_stalled));
    EXPECT_FALSE(bench.command().spindle_on);
    EXPECT_EQ(bench.coupling.resets, 1);
    EXPECT_EQ(bench.loop().fault_counts()[static_cast<std::size_t>(Fault::model_stalled)], 1u);
}

TEST(HapticLoop, SaysThatTheComputerWasSlowWhenTheBurrHasSunkIntoTheBoneMeanwhile) {
    Bench bench;
    bench.mill();
    bench.model_runs = false;
    bench.run(50 + ticks_to_fade());
    bench.model_runs = true;
    bench.next.has_bone_inside = true;
    bench.run(50);
    EXPECT_EQ(bench.shown().fault, describe(Fault::in_bone));
    EXPECT_EQ(bench.shown().notice,
              "the computer was too slow for a moment: the force went off, and the burr sank into the bone");
    bench.next.has_bone_inside = false;
    bench.run(500);
    EXPECT_EQ(bench.shown().fault, "");
    EXPECT_EQ(bench.shown().notice,
              "the spindle stays off, for the computer was too slow for a moment: let go of the pedal, and "
              "press it anew");
}

TEST(HapticLoop, FadesTheForceOfASessionThatEndsAndStopsTheSpindle) {
    Bench bench;
    bench.mill();
    ASSERT_EQ(bench.run(1), glm::dvec3(2.0, 0.0, 0.0));
    bench.loop().let_go();
    double before_n = 2.0;
    int ticks = 0;
    while (!bench.loop().has_let_go() && ++ticks < 100) {
        const double now_n = bench.run(1).x;
        EXPECT_LE(now_n, before_n);
        EXPECT_GE(now_n, before_n - 1.01 * 2.0 * tick_s / FadeOut::fade_s);
        EXPECT_FALSE(bench.shown().spindle_on);
        before_n = now_n;
    }
    EXPECT_EQ(before_n, 0.0);
    EXPECT_LE(ticks, ticks_to_fade());
}

TEST(HapticLoop, BringsTheForceBackByItselfWhenTheModelRunsAgainAndTheSpindleByAFreshPress) {
    Bench bench;
    bench.mill();
    bench.model_runs = false;
    bench.run(100);
    bench.model_runs = true;
    glm::dvec3 before = bench.run(1);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 now = bench.run(1);
        ASSERT_LE(glm::distance(now, before), 0.3);
        before = now;
    }
    EXPECT_EQ(before, glm::dvec3(2.0, 0.0, 0.0));
    EXPECT_FALSE(bench.command().spindle_on);
    bool pedal = false;
    bench.device.script = [&](double) { return DeviceState{.pedal = {pedal}}; };
    bench.run(1);
    pedal = true;
    bench.run(1);
    EXPECT_TRUE(bench.command().spindle_on);
}

TEST(HapticLoop, DoesNotLetACouplingsNanReachTheHand) {
    Bench bench;
    bench.mill();
    bench.coupling.force = [](const HandState&) { return glm::dvec3(NAN, 0.0, 0.0); };
    for (int i = 0; i < 1000; ++i) {
        ASSERT_TRUE(std::isfinite(glm::length(bench.run(1))));
        ASSERT_TRUE(std::isfinite(bench.command().pose.position_mm.x));
    }
    EXPECT_GE(bench.loop().fault_counts()[static_cast<std::size_t>(Fault::not_a_number)], 1u);
}

TEST(HapticLoop, KeepsTheSpindleOffAfterAJumpUntilThePedalHasBeenUp) {
    Bench bench;
    bench.mill();
    bool pedal = true;
    bench.device.script = [&](double) { return DeviceState{.position_mm = {40, 0, 0}, .pedal = {pedal}}; };
    bench.run(1);
    EXPECT_EQ(bench.shown().fault, describe(Fault::device_jumped));
    EXPECT_FALSE(bench.command().spindle_on) << "no channel is cut to where the device jumped";
    bench.run(1000);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    EXPECT_FALSE(bench.command().spindle_on);
    pedal = false;
    bench.run(1);
    pedal = true;
    bench.run(1);
    EXPECT_TRUE(bench.command().spindle_on);
}

TEST(HapticLoop, LeavesTheToolWhereItWasWhileTheDeviceIsLost) {
    Bench bench;
    bench.mill();
    bench.device.script = [](double) {
        return DeviceState{.position_mm = {NAN, 0, 0}, .pedal = {true}, .connected = false};
    };
    bench.run(ticks_to_fade());
    EXPECT_EQ(bench.shown().fault, describe(Fault::device_lost));
    EXPECT_EQ(bench.shown().hand_position_mm, glm::dvec3(0.0));
    EXPECT_FALSE(bench.command().spindle_on);
    EXPECT_EQ(bench.shown().force_n, glm::dvec3(0.0));
}

TEST(HapticLoop, FadesOutOnAStreakOfMissedDeadlines) {
    Bench bench;
    bench.mill();
    bench.run(15, 2);
    EXPECT_EQ(bench.shown().fault, describe(Fault::overrun));
    EXPECT_EQ(bench.loop().fault_counts()[static_cast<std::size_t>(Fault::overrun)], 1u);
    bench.run(1000);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    EXPECT_FALSE(bench.command().spindle_on) << "under a pedal that was held throughout";
}

TEST(HapticLoop, ShowsThatProtectedTissueWasTouchedLongEnoughToBeSeen) {
    Bench bench;
    bench.run(1);
    bench.next.touches_protected = true;
    bench.run(1);
    bench.next.touches_protected = false;
    bench.run(100);
    EXPECT_TRUE(bench.shown().touches_protected);
    bench.run(200);
    EXPECT_FALSE(bench.shown().touches_protected);
}

TEST(HapticLoop, MeasuresDepthFromWhereTheBurrFirstMetBone) {
    Bench bench;
    const auto file = std::filesystem::path(::testing::TempDir()) / "depth.csv";
    ForceLog log(file);
    testing::ScriptedDevice device;
    testing::ForcefulCoupling coupling;
    HapticLoop loop({device, coupling, *bench.results, bench.commands, bench.tool, bench.status, &log}, {});
    const auto tick_at = [&](double z_mm, double force_n) {
        device.script = [z_mm](double) { return DeviceState{.position_mm = {0, 0, z_mm}}; };
        coupling.force = [force_n](const HandState&) { return glm::dvec3(0, 0, force_n); };
        ++bench.next.step;
        bench.next.pose.position_mm = {0, 0, z_mm};
        bench.results->back() = bench.next;
        bench.results->publish();
        loop.tick(tick_s * static_cast<double>(bench.tick_number++), 0);
    };
    tick_at(5.0, 0.0);
    tick_at(4.0, 0.1);  // contact
    tick_at(3.5, 0.2);
    bench.tool.refresh();
    EXPECT_DOUBLE_EQ(bench.tool.front().depth_mm.value_or(0.0), 0.5) << "what clients are told";
    loop.settle(0.0, 0);
    log.close();
    std::FILE* in = std::fopen(file.c_str(), "r");
    ASSERT_NE(in, nullptr);
    std::array<char, 512> line{};
    for (const char* expected : {"depth_mm", ",0.0000,", ",0.0000,", ",0.5000,"}) {
        ASSERT_NE(std::fgets(line.data(), static_cast<int>(line.size()), in), nullptr);
        EXPECT_NE(std::string(line.data()).find(expected), std::string::npos) << line.data();
    }
    std::fclose(in);
    std::filesystem::remove(file);
}

TEST(HapticLoop, LetsGoOfAHandThatTheForceDrivesAndLocksTheSpindle) {
    Bench bench;
    double pushed_mm = 0.0;
    bench.coupling.force = [](const HandState&) { return glm::dvec3(2.0, 0.0, 0.0); };
    bench.device.script = [&](double now_s) {
        pushed_mm = 150.0 * now_s;  // 0.3 W: 15 mJ in 50 ms
        return DeviceState{.position_mm = {pushed_mm, 0.0, 0.0}, .pedal = {true}};
    };
    bench.run(45);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    bench.run(ticks_to_fade() + 20);
    EXPECT_EQ(bench.shown().force_n, glm::dvec3(0.0));
    EXPECT_EQ(bench.loop().fault_counts()[static_cast<std::size_t>(Fault::energy_to_hand)], 1U);
    EXPECT_GT(bench.loop().most_energy_to_hand_mj(), 15.0);

    // The hand holds still, the pedal is down: the force may come back, the spindle not before the pedal was
    // up.
    bool pedal = true;
    bench.coupling.force = [](const HandState&) { return glm::dvec3(0.0); };
    bench.device.script = [&](double) {
        return DeviceState{.position_mm = {pushed_mm, 0.0, 0.0}, .pedal = {pedal}};
    };
    bench.run(2000);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    EXPECT_FALSE(bench.command().spindle_on);
    pedal = false;
    bench.run(5);
    pedal = true;
    bench.run(5);
    EXPECT_TRUE(bench.command().spindle_on);
}

TEST(HapticLoop, DrivesNoHandWithAForceThatNobodyFeels) {
    Bench bench;
    bench.device.device_limits.gives_force = false;
    bench.coupling.force = [](const HandState&) { return glm::dvec3(2.0, 0.0, 0.0); };
    bench.device.script = [](double now_s) {
        return DeviceState{.position_mm = {150.0 * now_s, 0.0, 0.0}, .pedal = {true}};
    };
    bench.run(500);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    EXPECT_EQ(bench.shown().force_n, glm::dvec3(2.0, 0.0, 0.0)) << "clients are shown it";
    EXPECT_EQ(bench.loop().most_energy_to_hand_mj(), 0.0);
}

TEST(HapticLoop, DoesNotMistakeAHandThatPushesForOneThatIsPushed) {
    Bench bench;
    bench.coupling.force = [](const HandState&) { return glm::dvec3(-3.0, 0.0, 0.0); };
    bench.device.script = [](double now_s) {
        return DeviceState{.position_mm = {200.0 * now_s, 0.0, 0.0}, .pedal = {true}};
    };
    bench.run(500);
    EXPECT_EQ(bench.shown().fault, describe(Fault::none));
    EXPECT_LT(bench.loop().most_energy_to_hand_mj(), 1e-9);
}

/// A burr that shakes at 150 Hz in bone in front of it, pushed through it by the hand.
class ShakenBench {
  public:
    ShakenBench() {
        bench.options = {};
        bench.vibration = &vibration;
        bench.device.script = [this](double now_s) {
            return DeviceState{.position_mm = {6.0 * now_s, 0.0, 0.0}, .pedal = {pedal}};
        };
        bench.coupling.force = [](const HandState&) { return mean_n; };
        bench.next.force_n = mean_n;
        bench.next.engagement.count = 1;
        bench.next.engagement.patches[0] = {.normal = {1.0, 0.0, 0.0}, .cutting_n_s_per_mm = mean_n / 6.0};
    }

    /// Whether the force differs from the coupling's in any of so many ticks.
    bool shakes(int ticks) {
        bool shakes = false;
        for (int i = 0; i < ticks; ++i) {
            bench.next.time_s = tick_s * static_cast<double>(bench.tick_number);
            shakes |= glm::distance(bench.run(1), mean_n) > 0.05;
        }
        return shakes;
    }

    static constexpr glm::dvec3 mean_n{-0.5, 0.0, 0.0};
    HandpieceVibration vibration{{Burr{.spindle_rev_per_s = 150.0}},
                                 {.max_force_n = 3.3, .max_slew_n_per_s = ForceGuard::slew_n_per_s}};
    Bench bench;
    bool pedal = true;
};

TEST(HapticLoop, AddsTheVibrationOfACut) {
    ShakenBench shaken;
    EXPECT_TRUE(shaken.shakes(300));
    EXPECT_EQ(shaken.bench.shown().fault, describe(Fault::none));
}

TEST(HapticLoop, DoesNotShakeABurrThatStands) {
    ShakenBench shaken;
    shaken.pedal = false;
    shaken.shakes(20);  // the first force
    EXPECT_FALSE(shaken.shakes(300));
    shaken.pedal = true;
    EXPECT_TRUE(shaken.shakes(300));
    shaken.pedal = false;
    shaken.shakes(1);
    EXPECT_FALSE(shaken.shakes(300)) << "at once";
}

TEST(HapticLoop, DoesNotShakeAForceThatIsOffOrFades) {
    ShakenBench shaken;
    EXPECT_TRUE(shaken.shakes(300));
    shaken.bench.model_runs = false;
    shaken.shakes(50 + ticks_to_fade());
    double last_n = 0.0;
    for (int i = 0; i < 100; ++i) EXPECT_EQ(shaken.bench.run(1), glm::dvec3(0.0));
    shaken.bench.model_runs = true;
    // Fades in: only ever grows.
    bool is_back = false;
    for (int i = 0; i < 500 && !is_back; ++i) {
        shaken.bench.next.time_s = tick_s * static_cast<double>(shaken.bench.tick_number);
        const double now_n = glm::length(shaken.bench.run(1));
        ASSERT_GE(now_n, last_n);
        last_n = now_n;
        is_back = now_n >= 0.5;
    }
    EXPECT_TRUE(is_back);
    EXPECT_FALSE(shaken.shakes(300)) << "the burr stands until the pedal is pressed anew";
    shaken.pedal = false;
    shaken.shakes(1);
    shaken.pedal = true;
    EXPECT_TRUE(shaken.shakes(300));
}

TEST(HapticLoop, HoldsStillAsLongAsTheGateSaysAndTheSpindleUntilThePedalHasBeenUp) {
    Bench bench;
    bench.mill();
    bench.gate.stillness.set(true);
    EXPECT_LE(glm::length(bench.run(1)), 2.0);
    EXPECT_FALSE(bench.shown().spindle_on);
    EXPECT_EQ(bench.run(ticks_to_fade()), glm::dvec3(0.0));
    EXPECT_EQ(bench.shown().fault, describe(Fault::paused));
    bench.run(1000);
    EXPECT_EQ(bench.run(1), glm::dvec3(0.0));
    bench.gate.stillness.set(false);
    bench.run(1000);
    EXPECT_EQ(bench.run(1), glm::dvec3(2.0, 0.0, 0.0));
    EXPECT_FALSE(bench.shown().spindle_on) << "the pedal has been down all the time";
    EXPECT_EQ(
        bench.shown().notice,
        "the spindle stays off after a pause, an undo or a placing of the tool: let go of the pedal, and "
        "press it anew");
    bench.device.script = [](double) { return DeviceState{}; };
    bench.run(2);
    bench.device.script = [](double) { return DeviceState{.pedal = {true}}; };
    bench.run(2);
    EXPECT_TRUE(bench.shown().spindle_on);
}

TEST(HapticLoop, NeverFeelsBoneThatComesBackRoundTheBurr) {
    Bench bench;
    bench.mill();
    // The same result that has the bone back says so: nothing of it may reach the hand.
    ++bench.next.restored_changes;
    bench.coupling.force = [](const HandState&) { return glm::dvec3(0.0, 3.0, 0.0); };
    const glm::dvec3 first = bench.run(1);
    EXPECT_EQ(first.y, 0.0);
    EXPECT_LE(first.x, 2.0);
    for (int i = 0; i < ticks_to_fade(); ++i) EXPECT_EQ(bench.run(1).y, 0.0);
}

TEST(HapticLoop, PlacesTheToolUnderAHandThatStaysWhereItIs) {
    Bench bench;
    bench.options.mapping = {.rotation = glm::dmat3({0, 1, 0}, {-1, 0, 0}, {0, 0, 1}), .scale = 0.5};
    bench.device.script = [](double) { return DeviceState{.position_mm = {3.0, 4.0, 5.0}}; };
    bench.coupling.force = [](const HandState&) { return glm::dvec3(0.0, 0.5, 0.0); };
    bench.run(20);
    const ToolPose wanted{{40.0, -20.0, 7.0}, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))};
    bench.placements.back() = {.number = 1, .pose = wanted};
    bench.placements.publish();
    bench.run(20);
    EXPECT_EQ(bench.gate.placed, 0U) << "not while a force is felt";

    bench.gate.stillness.set(true);
    bench.run(ticks_to_fade() + 5);
    EXPECT_EQ(bench.gate.placed, 1U);
    EXPECT_LT(glm::distance(bench.shown().hand_position_mm, wanted.position_mm), 1e-9);
    EXPECT_LT(glm::distance(bench.shown().burr_position_mm, wanted.position_mm), 1e-9);
    EXPECT_LT(glm::distance(bench.shown().spindle_axis, wanted.spindle_axis), 1e-9);
    EXPECT_EQ(bench.shown().depth_mm, 0.0);

    // The hand moves on from there, as far as before, and feels the force by the patient's axes.
    bench.gate.stillness.set(false);
    bench.device.script = [](double) { return DeviceState{.position_mm = {3.0, 4.0, 7.0}}; };
    bench.run(1000);
    EXPECT_NEAR(glm::distance(bench.shown().hand_position_mm, wanted.position_mm), 1.0, 1e-6);
    EXPECT_NEAR(glm::length(bench.run(1)), 0.5, 1e-9);
    EXPECT_LT(glm::distance(bench.shown().force_n, glm::dvec3(0.0, 0.5, 0.0)), 1e-9);
}

/// Another fault in a session whose tool moves relative to the hand's bone.
class InterruptedBench : public ::testing::TestWithParam<bool> {
  public:
    InterruptedBench() {
        bench.next.room_for_change_mm = 1.0;
        bench.mill();
        // The milling model is late, or the force goes off for a result that is none.
        is_late = GetParam();
        (is_late ? bench.model_runs : bench.next.valid) = false;
        bench.run(100);
        EXPECT_NE(bench.shown().fault, describe(Fault::none));
        // The fault has stopped the spindle: only a press that came later may turn it again.
        bench.device.script = [](double) { return DeviceState{}; };
        bench.run(2);
        bench.device.script = [](double) { return DeviceState{.pedal = {true}}; };
        bench.run(2);
    }
    /// All is well again, under a pedal that was pressed meanwhile.
    bool spindle_turns_afterwards() {
        bench.model_runs = bench.next.valid = true;
        bench.run(1000);
        EXPECT_EQ(bench.shown().fault, describe(Fault::none));
        return bench.shown().spindle_on;
    }
    void expect_a_fresh_press_to_turn_it() {
        bench.device.script = [](double) { return DeviceState{}; };
        bench.run(2);
        bench.device.script = [](double) { return DeviceState{.pedal = {true}}; };
        bench.run(2);
        EXPECT_TRUE(bench.shown().spindle_on);
    }
    Bench bench;
    bool is_late = false;
};

TEST_P(InterruptedBench, TurnsOnIfNothingElseHappens) {
    EXPECT_TRUE(spindle_turns_afterwards());
}

TEST_P(InterruptedBench, WithdrawsThePedalForAPause) {
    bench.gate.stillness.set(true);
    bench.run(50);
    bench.gate.stillness.set(false);
    EXPECT_FALSE(spindle_turns_afterwards());
    expect_a_fresh_press_to_turn_it();
}

TEST_P(InterruptedBench, WithdrawsThePedalForAPauseBetweenTwoTicks) {
    bench.gate.stillness.set(true);
    bench.gate.stillness.set(false);
    EXPECT_FALSE(spindle_turns_afterwards());
    expect_a_fresh_press_to_turn_it();
}

TEST_P(InterruptedBench, WithdrawsThePedalForAToolThatIsPlaced) {
    bench.placements.back() = {.number = 1, .pose = {{7.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
    bench.placements.publish();
    bench.run(1);
    EXPECT_EQ(bench.gate.placed, 1U);
    EXPECT_FALSE(spindle_turns_afterwards());
    EXPECT_NEAR(bench.shown().hand_position_mm.x, 7.0, 1e-9);
    expect_a_fresh_press_to_turn_it();
}

TEST_P(InterruptedBench, WithdrawsThePedalForBoneThatCameBackInAResultThatWasSkipped) {
    bench.next.restored_changes += 3;
    EXPECT_FALSE(spindle_turns_afterwards());
    expect_a_fresh_press_to_turn_it();
}

TEST_P(InterruptedBench, ChangesNoBurrUnderAPedalThatIsHeld) {
    bench.device.script = [](double) { return DeviceState{.pedal = {true}, .burr = 2}; };
    EXPECT_TRUE(spindle_turns_afterwards());
    EXPECT_EQ(bench.shown().burr, 1U);
    EXPECT_EQ(bench.shown().notice, describe(BurrChange::spindle));
}

INSTANTIATE_TEST_SUITE_P(OfTheModel, InterruptedBench, ::testing::Bool(),
                         [](const auto& late) { return late.param ? "ThatIsLate" : "ThatIsNone"; });

TEST(HapticLoop, ChangesNoBurrBetweenAPressAndItsEffect) {
    Bench bench;
    bench.next.room_for_change_mm = 1.0;
    std::optional<std::size_t> burr;
    bool is_down = false;
    bench.device.script = [&](double) {
        return DeviceState{.pedal = {.is_down = is_down, .acts_after_s = 0.1}, .burr = burr};
    };
    bench.run(10);
    is_down = true;
    bench.run(50);
    ASSERT_FALSE(bench.shown().spindle_on);
    burr = 2;
    bench.run(30);
    EXPECT_EQ(bench.shown().burr, 1U);
    bench.run(100);
    EXPECT_TRUE(bench.shown().spindle_on);
    EXPECT_EQ(bench.shown().burr, 1U);
    is_down = false;
    bench.run(5);
    EXPECT_EQ(bench.shown().burr, 2U);
}

}  // namespace
}  // namespace osteomill
