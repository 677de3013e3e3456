// A session whose strokes are undone, redone and marked, recorded and shown again: the real programs.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "common/recording/playhead.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/folder_test.h"

namespace osteomill::testing {
namespace {

class SessionControlsProgram : public FolderTest {
  protected:
    SessionControlsProgram() {
        // Two strokes: down at x = -1, up, and down at x = 1.
        std::ofstream(file("motion.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                             "0.0,-1,0,6,0,0,1,0\n"
                                             "0.2,-1,0,6,0,0,1,1\n"
                                             "0.8,-1,0,2.5,0,0,1,1\n"
                                             "1.4,-1,0,6,0,0,1,0\n"
                                             "1.6,1,0,6,0,0,1,0\n"
                                             "1.8,1,0,6,0,0,1,1\n"
                                             "2.4,1,0,2.5,0,0,1,1\n"
                                             "3.0,1,0,6,0,0,1,0\n"
                                             "5.0,1,0,6,0,0,1,0\n";
        write_block(file("block.nrrd"));
    }
    /// Runs a session with this script; returns its measurements.
    nlohmann::json run(const std::string& script, std::vector<std::string> more = {}) const {
        std::ofstream(file("script.csv")) << "t_s,action,text\n" << script;
        std::vector<std::string> command{HAPTIC_SERVER,       "--clock",      "virtual",          "--bone",
                                         file("block.nrrd"),  "--trajectory", file("motion.csv"), "--json",
                                         file("server.json"), "--controls",   file("script.csv")};
        command.insert(command.end(), more.begin(), more.end());
        const Finished finished = run_program(command);
        EXPECT_EQ(finished.status, 0) << finished.err;
        return json("server.json");
    }
};

TEST_F(SessionControlsProgram, UndoesAndRedoesStrokesToTheBit) {
    const auto first = run("1.5,finish,\n");
    const auto both = run("");
    const auto none = run("0.0,finish,\n");
    EXPECT_GT(both.at("removed_mm3").at("total"), first.at("removed_mm3").at("total"));
    EXPECT_LT(first.at("duration_s"), 2.0);

    const auto undone = run("3.2,undo,\n");
    EXPECT_EQ(undone.at("bone_checksum"), first.at("bone_checksum"));
    EXPECT_EQ(undone.at("removed_mm3"), first.at("removed_mm3"));
    EXPECT_EQ(run("3.2,undo,\n3.4,redo,\n").at("bone_checksum"), both.at("bone_checksum"));
    const auto reset = run("3.2,reset,\n");
    EXPECT_EQ(reset.at("bone_checksum"), none.at("bone_checksum"));
    EXPECT_EQ(reset.at("removed_mm3").at("total"), 0.0);
    EXPECT_EQ(run("3.2,reset,\n3.5,redo,\n").at("bone_checksum"), first.at("bone_checksum"));
}

TEST_F(SessionControlsProgram, LeavesARecordingThatHoldsEveryUndoAndMark) {
    const auto measured = run("1.5,mark,first hole\n3.2,undo,\n3.4,redo,\n3.5,redo,\n3.6,undo,\n",
                              {"--record", file("a.pcap"), "--save-bone", file("left.nrrd")});
    const Finished read = run_program({PACKET_REPLAY, file("a.pcap"), "--info", "--json", file("info.json")});
    ASSERT_EQ(read.status, 0) << read.err;
    EXPECT_EQ(json("info.json").at("bone_checksum"), measured.at("bone_checksum"));
    EXPECT_NEAR(json("info.json").at("removed_mm3").at("total").get<double>(),
                measured.at("removed_mm3").at("total").get<double>(), 1e-6);

    Playhead playhead(file("a.pcap"));
    std::vector<ControlEvent> events;
    SessionStatus status;
    while (playhead.step(std::numeric_limits<double>::infinity()) == Playhead::Step::state) {
        events.insert(events.end(), playhead.state().events.begin(), playhead.state().events.end());
        status = playhead.state().status;
    }
    ASSERT_EQ(events.size(), 5U);
    EXPECT_EQ(events[0].text, "first hole");
    EXPECT_NEAR(events[0].time_s, 1.5, 0.05);
    EXPECT_EQ(events[3].action, SessionAction::redo);
    EXPECT_TRUE(events[3].is_refused);
    EXPECT_EQ(status.undo_steps, 1U);
    EXPECT_EQ(status.redo_steps, 1U);

    const Finished player =
        run_program({"/usr/bin/env", "ASAN_OPTIONS=detect_leaks=0", RENDER_CLIENT, "--offscreen",
                     "--window-size", "64x48", "--frames", "100000", "--json", file("player.json"),
                     "--replay", file("a.pcap"), "--speed", "4"});
    ASSERT_EQ(player.status, 0) << player.err;
    EXPECT_EQ(json("player.json").at("bone_checksum"), measured.at("bone_checksum"));
}

// By session time, which is the same on any machine.
TEST_F(SessionControlsProgram, AnswersAtOnceWhatIsAskedForBehindAResetOfManyStrokes) {
    constexpr int strokes = 100;
    constexpr double period_s = 0.5;
    std::ofstream motion(file("motion.csv"));
    motion << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n";
    for (int i = 0; i < strokes; ++i)
        for (const auto& [share, z_mm, pedal] :
             {std::tuple(0.0, 5.0, 0), std::tuple(0.1, 5.0, 1), std::tuple(0.5, 3.5 - 0.01 * i, 1),
              std::tuple(0.8, 5.0, 1), std::tuple(0.9, 5.0, 0)})
            motion << period_s * (i + share) << ',' << 0.2 * (i % 20) - 2.0 << ",0," << z_mm << ",0,0,1,"
                   << pedal << '\n';
    motion << strokes * period_s + 8.0 << ",0,0,6,0,0,1,0\n";
    motion.close();
    const double asked_s = strokes * period_s + 1.0;
    const std::string at = std::to_string(asked_s);
    const auto reset =
        run(at + ",reset,\n" + at + ",mark,behind\n" + at + ",finish,\n", {"--record", file("a.pcap")});
    EXPECT_EQ(reset.at("removed_mm3").at("total"), 0.0);
    EXPECT_LT(reset.at("duration_s").get<double>(), asked_s + 1.0);
    Playhead playhead(file("a.pcap"));
    std::vector<ControlEvent> events;
    std::uint32_t redo_steps = 0;
    while (playhead.step(std::numeric_limits<double>::infinity()) == Playhead::Step::state) {
        events.insert(events.end(), playhead.state().events.begin(), playhead.state().events.end());
        redo_steps = playhead.state().status.redo_steps;
    }
    ASSERT_EQ(events.size(), 3U);
    for (const ControlEvent& event : events) {
        EXPECT_FALSE(event.is_refused) << event.text;
        EXPECT_LT(event.time_s, asked_s + 1.0);
    }
    EXPECT_GE(redo_steps, 60U) << "at a frame each these take two seconds; not every stroke finds bone";
}

TEST_F(SessionControlsProgram, SavesTheSurfaceBesideTheBone) {
    run("3.2,save,.stl\n3.3,save,\n", {"--save-bone", file("left.nrrd")});
    // A binary STL: 80 bytes, a count, 50 bytes for each triangle.
    ASSERT_TRUE(std::filesystem::exists(file("left.stl")));
    std::ifstream in(file("left.stl"), std::ios::binary);
    in.seekg(80);
    std::uint32_t triangles = 0;
    in.read(reinterpret_cast<char*>(&triangles), sizeof triangles);
    EXPECT_GT(triangles, 1000U);
    EXPECT_EQ(std::filesystem::file_size(file("left.stl")), 84 + 50 * std::uintmax_t{triangles});
}

// By chips alone: edges that rub ask for the same force at any speed.
TEST_F(SessionControlsProgram, NeedsMoreForceAtALowerSpeed) {
    const std::vector<std::string> chips{"--force-model", "published"};
    const auto own = run("", chips);  // 40 000 rpm
    const auto slower = run("0,speed,100\n", chips);
    const auto back = run("0,speed,100\n0.05,speed,0\n", chips);
    EXPECT_GT(slower.at("peak_force_n").get<double>(), 1.2 * own.at("peak_force_n").get<double>());
    EXPECT_LT(slower.at("removed_mm3").at("total").get<double>(),
              0.8 * own.at("removed_mm3").at("total").get<double>());
    EXPECT_EQ(back.at("bone_checksum"), own.at("bone_checksum"));
}

TEST_F(SessionControlsProgram, HoldsStillWhilePaused) {
    // Paused through the second stroke: nothing of it is cut, though the pedal comes and goes.
    const auto first = run("1.5,finish,\n");
    const auto paused = run("1.5,pause,\n4.0,resume,\n");
    EXPECT_EQ(paused.at("bone_checksum"), first.at("bone_checksum"));
}

TEST_F(SessionControlsProgram, SaysInOneLineWhatIsWrongWithAScript) {
    std::ofstream(file("script.csv")) << "t_s,action,text\n1,undu,\n";
    const Finished finished = run_program(
        {HAPTIC_SERVER, "--clock", "virtual", "--duration-s", "1", "--controls", file("script.csv")});
    EXPECT_EQ(finished.status, 1);
    EXPECT_EQ(finished.err, "haptic_server: " + file("script.csv") +
                                ":2: action 'undu' is not one of mark, pause, resume, undo, redo, reset, "
                                "save, finish, speed, fixture\n");
}

}  // namespace
}  // namespace osteomill::testing
