// A session recorded, inspected, shown again and cut by other people's tools: the real programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/recording/playhead.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/folder_test.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Recording : public FolderTest {
  protected:
    Recording() {
        std::ofstream(file("tooth.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                            "0.0,0.5,0.2,5.5,0,0,1,0\n"
                                            "0.4,0.5,0.2,4.5,0,0,1,1\n"
                                            "1.6,0.5,0.2,2.9,0,0,1,1\n";
        std::ofstream(file("block.csv")) << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                            "0.0,-1,0,3.5,0,0,1,0\n"
                                            "0.4,-1,0,2.5,0,0,1,1\n"
                                            "1.4,-1,0,1.0,0,0,1,1\n"
                                            "2.4,1,0,1.0,0,0,1,1\n";
        write_block(file("block.nrrd"));
    }

    std::vector<std::string> server(const std::string& scene, const std::string& report) const {
        std::vector<std::string> command{HAPTIC_SERVER,        "--clock", "virtual",   "--trajectory",
                                         file(scene + ".csv"), "--json",  file(report)};
        if (scene == "block") command.insert(command.end(), {"--bone", file("block.nrrd")});
        return command;
    }
    /// Drills on the virtual clock; server.json says how it went.
    void record(const std::string& name, const std::string& scene = "block") const {
        std::vector<std::string> command = server(scene, "server.json");
        command.insert(command.end(), {"--record", file(name)});
        const Finished finished = run_program(command);
        ASSERT_EQ(finished.status, 0) << finished.err;
    }
    /// The same in a shell where files may have so many KiB: a full disk.
    Finished record_on_disk_of(std::uintmax_t kibibytes, const std::string& name,
                               const std::string& report) const {
        std::string command = "ulimit -f " + std::to_string(kibibytes) + "; exec";
        for (const std::string& word : server("block", report)) command += " " + word;
        return run_program({"/bin/bash", "-c", command + " --record " + file(name)});
    }
    nlohmann::json info(const std::string& name) const {
        const Finished read = run_program({PACKET_REPLAY, file(name), "--info", "--json", file("info.json")});
        EXPECT_EQ(read.status, 0) << read.err;
        return json("info.json");
    }
    std::vector<std::string> client(const std::vector<std::string>& source, const std::string& report) const {
        // OpenGL drivers leak and are unloaded before the leak checker of an instrumented client looks.
        std::vector<std::string> command{"/usr/bin/env",  "ASAN_OPTIONS=detect_leaks=0",
                                         RENDER_CLIENT,   "--offscreen",
                                         "--window-size", "64x48",
                                         "--frames",      "100000",
                                         "--json",        file(report)};
        command.insert(command.end(), source.begin(), source.end());
        return command;
    }
};

TEST_F(Recording, LeavesEveryoneWithTheServersBone) {
    record("a.pcap", "tooth");
    const auto served = json("server.json");
    EXPECT_EQ(served.at("recording").at("error"), nullptr);

    const auto read = info("a.pcap");
    EXPECT_EQ(read.at("bone_checksum"), served.at("bone_checksum"));
    EXPECT_EQ(read.at("protocol"), "2.3");
    EXPECT_EQ(read.at("frames"), served.at("recording").at("frames"));
    EXPECT_NEAR(read.at("duration_s").get<double>(), served.at("duration_s").get<double>(), 1e-6);
    EXPECT_GT(read.at("removed_mm3").at("total"), 0.1);
    for (const auto& [tissue, removed_mm3] : served.at("removed_mm3").items())
        EXPECT_NEAR(read.at("removed_mm3").at(tissue).get<double>(), removed_mm3.get<double>(), 1e-6);

    const Finished player = run_program(client({"--replay", file("a.pcap"), "--speed", "4"}, "player.json"));
    ASSERT_EQ(player.status, 0) << player.err;
    EXPECT_EQ(json("player.json").at("bone_checksum"), served.at("bone_checksum"));
    EXPECT_GT(json("player.json").at("dirty_bricks_uploaded"), 0);

    ChildProcess replay(
        {PACKET_REPLAY, file("a.pcap"), "--listen", "127.0.0.1:0", "--speed", "4", "--from-s", "1"});
    const auto address = replay.address();
    ASSERT_TRUE(address) << replay.err();
    const Finished viewer = run_program(client({"--connect", *address}, "viewer.json"));
    ASSERT_EQ(viewer.status, 0) << viewer.err;
    ASSERT_EQ(replay.wait(), 0) << replay.err();
    EXPECT_EQ(json("viewer.json").at("bone_checksum"), served.at("bone_checksum"));
    EXPECT_EQ(json("viewer.json").at("checksum_mismatches"), 0);
}

TEST_F(Recording, OfTheSameSessionIsTheSameButForItsDate) {
    record("a.pcap");
    record("b.pcap");
    for (const std::string name : {"a", "b"}) {
        const Finished read =
            run_program({PACKET_REPLAY, file(name + ".pcap"), "--csv", file(name + ".csv")});
        ASSERT_EQ(read.status, 0) << read.err;
    }
    std::ifstream a(file("a.csv")), b(file("b.csv"));
    const std::string table{std::istreambuf_iterator<char>(a), {}};
    EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 2400) << "a line a tick";
    EXPECT_EQ(table, std::string(std::istreambuf_iterator<char>(b), {}));
}

/// A log's columns, by name.
using Log = std::map<std::string, std::vector<double>>;

Log log_in(const std::string& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    std::vector<std::string> names;
    std::istringstream header(line);
    for (std::string name; std::getline(header, name, ',');) names.push_back(name);
    Log log;
    while (std::getline(in, line)) {
        std::istringstream cells(line);
        std::string cell;
        for (const std::string& name : names)
            log[name].push_back(std::getline(cells, cell, ',') ? std::stod(cell) : NAN);
    }
    return log;
}

TEST_F(Recording, GivesTheMotionForASessionThatMakesItAgain) {
    record("a.pcap");
    Finished finished = run_program({PACKET_REPLAY, file("a.pcap"), "--trajectory", file("again.csv")});
    ASSERT_EQ(finished.status, 0) << finished.err;
    finished = run_program({HAPTIC_SERVER, "--clock", "virtual", "--bone", file("block.nrrd"), "--grip",
                            "rails", "--trajectory", file("again.csv"), "--log-csv", file("b.csv")});
    ASSERT_EQ(finished.status, 0) << finished.err;
    finished = run_program({PACKET_REPLAY, file("a.pcap"), "--csv", file("a.csv")});
    ASSERT_EQ(finished.status, 0) << finished.err;
    const Log a = log_in(file("a.csv")), b = log_in(file("b.csv"));
    ASSERT_GT(a.at("t_s").size(), 2400U);
    ASSERT_NEAR(static_cast<double>(a.at("t_s").size()), static_cast<double>(b.at("t_s").size()), 2.0);
    // Logs have four decimals, and the motion that was made again was written with as many. The force of the
    // burr's teeth amplifies the rounding a little.
    const std::vector<std::pair<std::string, double>> bounds{
        {"t_s", 1e-9},         {"hand_x_mm", 2.1e-4}, {"hand_y_mm", 2.1e-4},
        {"hand_z_mm", 2.1e-4}, {"burr_x_mm", 0.02},   {"burr_y_mm", 0.02},
        {"burr_z_mm", 0.02},   {"spindle", 0.0},      {"fault", 0.0}};
    for (const auto& [name, bound] : bounds)
        for (std::size_t tick = 0; tick < std::min(a.at("t_s").size(), b.at("t_s").size()); ++tick)
            ASSERT_NEAR(a.at(name)[tick], b.at(name)[tick], bound) << name << ", tick " << tick;
    EXPECT_GT(a.at("removed_mm3").back(), 1.0);
    EXPECT_NEAR(b.at("removed_mm3").back(), a.at("removed_mm3").back(), 2e-3 * a.at("removed_mm3").back());
}

TEST_F(Recording, GivesTheMotionOfOneSessionOnly) {
    record("a.pcap");
    std::ofstream(file("both.pcap"), std::ios::binary) << text("a.pcap") << text("a.pcap").substr(24);
    const Finished finished =
        run_program({PACKET_REPLAY, file("both.pcap"), "--trajectory", file("again.csv")});
    EXPECT_EQ(finished.status, 1);
    EXPECT_THAT(finished.err, HasSubstr("holds more than one session"));
    EXPECT_FALSE(std::filesystem::exists(file("again.csv")));
}

TEST_F(Recording, BecomesAFilm) {
    record("a.pcap");
    const std::string film = file("a.mp4");
    const Finished made =
        run_program({"/usr/bin/env", "ASAN_OPTIONS=detect_leaks=0", RENDER_CLIENT, "--replay", file("a.pcap"),
                     "--film", film, "--window-size", "101x80", "--from-s", "1", "--speed", "2"});
    ASSERT_EQ(made.status, 0) << made.err;
    const Finished seen = run_program({"/usr/bin/env", "ffprobe", "-v", "error", "-count_frames",
                                       "-show_entries", "stream=width,height,nb_read_frames,r_frame_rate",
                                       "-of", "default=nokey=1:noprint_wrappers=1", film});
    ASSERT_EQ(seen.status, 0) << seen.err;
    // The recording takes 2.4 s and the rest of its last frame.
    const double duration_s = info("a.pcap").at("duration_s");
    const auto frames = static_cast<int>((duration_s - 1.0) / 2.0 * 30.0) + 1;
    EXPECT_EQ(seen.out, "102\n80\n30/1\n" + std::to_string(frames) + "\n") << "of an even width";

    // packet_replay has the film made.
    const Finished without = run_program({"/usr/bin/env", "PATH=/nowhere", "ASAN_OPTIONS=detect_leaks=0",
                                          PACKET_REPLAY, file("a.pcap"), "--film", file("b.mp4")});
    EXPECT_EQ(without.status, 1);
    EXPECT_THAT(without.err, HasSubstr("install Debian's package ffmpeg"));
    EXPECT_EQ(std::count(without.err.begin(), without.err.end(), '\n'), 1) << without.err;
    EXPECT_FALSE(std::filesystem::exists(file("b.mp4")));
}

TEST_F(Recording, HoldsEveryTickAsTheLogHasIt) {
    // Two burrs with shanks that are wider than they: deep in the bone a shank rubs. Paused, there is a
    // fault.
    std::ofstream(file("shanks.toml")) << R"(name = "shanks"
start_burr = "small"
[bone]
file = "block.nrrd"
[[burrs]]
name = "small"
diameter_mm = 2.0
shank = [[0.8, 0.4], [1.2, 1.6], [20.0, 1.6]]
[[burrs]]
name = "large"
diameter_mm = 3.0
shank = [[1.0, 0.6], [1.8, 2.4], [20.0, 2.4]]
[start_pose]
position_mm = [0.0, 0.0, 4.5]
)";
    std::ofstream(file("shanks.csv"))
        << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal,burr\n"
           "0.0,0,0,4.5,0,0,1,0,0\n0.3,0,0,3.5,0,0,1,1,0\n"
           "1.3,0.5,0,0.2,0.2,0.1,1,1,0\n1.6,0,0,4.5,0,0,1,0,0\n"
           "2.2,0,0,5.5,0,0,1,0,1\n2.5,0,1,3.5,0,0,1,1,1\n3.4,0,1,0.5,0,0,1,1,1\n";
    std::ofstream(file("pause.csv")) << "t_s,action,text\n2.8,pause,\n3.0,resume,\n";
    struct Session {
        std::string name;
        std::vector<std::string> options;
    };
    for (const Session& session :
         {Session{"shanks",
                  {"--scene", file("shanks.toml"), "--trajectory", file("shanks.csv"), "--controls",
                   file("pause.csv")}},
          Session{"block", {"--bone", file("block.nrrd"), "--trajectory", file("block.csv")}},
          Session{"tooth", {"--trajectory", file("tooth.csv"), "--grip", "light", "--vibration"}}}) {
        const std::string log = file(session.name + ".log.csv");
        const std::string recording = file(session.name + ".pcap");
        std::vector<std::string> command{HAPTIC_SERVER, "--clock",   "virtual", "--record",
                                         recording,     "--log-csv", log};
        command.insert(command.end(), session.options.begin(), session.options.end());
        const Finished served = run_program(command);
        ASSERT_EQ(served.status, 0) << served.err;
        const Finished read = run_program({PACKET_REPLAY, recording, "--csv", file("read.csv")});
        ASSERT_EQ(read.status, 0) << read.err;
        EXPECT_EQ(text("read.csv"), text(session.name + ".log.csv")) << session.name;
        EXPECT_GT(info(session.name + ".pcap").at("ticks"), 1500);
        EXPECT_EQ(info(session.name + ".pcap").at("missed_ticks"), 0);
    }
    // There was something to get wrong.
    const std::string shanks = text("shanks.log.csv");
    EXPECT_THAT(shanks, HasSubstr("shank_torque_z_n_mm\n"));
    EXPECT_THAT(shanks, HasSubstr(",8,")) << "no fault";
    std::size_t rubbing = 0;
    std::istringstream lines(shanks);
    for (std::string line; std::getline(lines, line);)
        if (!line.ends_with("0.0000,0.0000,0.0000")) ++rubbing;
    EXPECT_GT(rubbing, 100U);
    std::size_t ticks_of_large = 0;
    Playhead playhead(file("shanks.pcap"));
    while (playhead.step(std::numeric_limits<double>::infinity()) != Playhead::Step::end)
        for (const TickSample& tick : playhead.ticks()) ticks_of_large += tick.burr;
    EXPECT_GT(ticks_of_large, 500U);
}

TEST_F(Recording, ThatIsTornLosesTheTicksOfItsLastSecondAtMost) {
    record("a.pcap");
    ASSERT_EQ(run_program({PACKET_REPLAY, file("a.pcap"), "--csv", file("a.csv")}).status, 0);
    const std::string whole = text("a.csv");
    std::vector<std::pair<std::uint64_t, double>> packets;  // end, time since the recording began
    PacketReader reader(file("a.pcap"));
    std::optional<Stamp> began;
    while (const auto packet = reader.next()) {
        if (!began) began = packet->stamp;
        packets.emplace_back(reader.place().offset_bytes,
                             std::chrono::duration<double>(packet->stamp - *began).count());
    }
    for (const double share : {0.4, 0.7, 0.95}) {
        const auto& [end, time_s] =
            packets[static_cast<std::size_t>(share * static_cast<double>(packets.size()))];
        std::filesystem::copy_file(file("a.pcap"), file("torn.pcap"),
                                   std::filesystem::copy_options::overwrite_existing);
        std::filesystem::resize_file(file("torn.pcap"), end + 11);
        ASSERT_EQ(run_program({PACKET_REPLAY, file("torn.pcap"), "--csv", file("torn.csv")}).status, 0);
        const std::string torn = text("torn.csv");
        EXPECT_EQ(torn, whole.substr(0, torn.size()));
        EXPECT_TRUE(torn.ends_with('\n'));
        const std::size_t last_line = torn.rfind('\n', torn.size() - 2) + 1;
        EXPECT_GT(std::stod(torn.substr(last_line)), time_s - 0.2);
    }
}

TEST_F(Recording, HoldsOnlyStatesWhereNoTicksAreAskedFor) {
    std::vector<std::string> command = server("block", "server.json");
    command.insert(command.end(), {"--record", file("a.pcap"), "--record-rate-hz", "30"});
    ASSERT_EQ(run_program(command).status, 0);
    EXPECT_EQ(info("a.pcap").at("ticks"), 0);
    record("b.pcap");
    for (const auto& [recording, option] :
         {std::pair{"a", "--csv"}, std::pair{"a", "--states-csv"}, std::pair{"b", "--states-csv"}}) {
        ASSERT_EQ(run_program({PACKET_REPLAY, file(std::string(recording) + ".pcap"), option,
                               file(std::string(recording) + option)})
                      .status,
                  0);
        EXPECT_THAT(text(std::string(recording) + option),
                    ::testing::StartsWith("time_s,session_time_s,burr_x_mm,"));
    }
    EXPECT_EQ(text("a--csv"), text("a--states-csv"));
    command.back() = "100";
    EXPECT_EQ(run_program(command).status, 2);
}

TEST_F(Recording, WithADamagedMiddleIsNotTakenForATornEnd) {
    record("a.pcap");
    std::ifstream in(file("a.pcap"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    PacketReader packets(file("a.pcap"));
    std::size_t at = 0;
    for (int i = 0; i < 20; ++i) at = packets.next()->place.offset_bytes;
    const auto replay_with = [&](std::size_t offset, char change) {
        std::string damaged = bytes;
        damaged[at + offset] = static_cast<char>(damaged[at + offset] ^ change);
        std::ofstream(file("damaged.pcap"), std::ios::binary) << damaged;
        return run_program({PACKET_REPLAY, file("damaged.pcap"), "--info"});
    };
    constexpr std::size_t nanoseconds = 4, kept = 8;
    for (const auto& [offset, change, what] :
         {std::tuple{nanoseconds + 1, '\x10', "its time stamp is not the one"},
          std::tuple{kept + 1, '\x40', "packet"}, std::tuple{kept + 2, '\x01', "whole packets follow it"}}) {
        const Finished replay = replay_with(offset, change);
        EXPECT_EQ(replay.status, 1) << replay.out;
        EXPECT_THAT(replay.err, AllOf(HasSubstr("damaged.pcap, packet 20 at byte "), HasSubstr(what)));
    }
}

TEST_F(Recording, StandsStillWhileTheDiskIsFullAndTheSessionGoesOn) {
    record("whole.pcap");
    const auto needed = std::filesystem::file_size(file("whole.pcap")) / 1024;
    const Finished server = record_on_disk_of(needed - 5, "a.pcap", "full.json");
    EXPECT_EQ(server.status, 1);
    EXPECT_THAT(server.err, AllOf(HasSubstr("a.part.pcap: no more than "), HasSubstr("File too large"),
                                  HasSubstr("the session goes on"),
                                  HasSubstr("lies in " + file("a.part.pcap") + ", which packet_replay")));
    const auto full = json("full.json");
    EXPECT_EQ(full.at("bone_checksum"), json("server.json").at("bone_checksum"));
    EXPECT_EQ(full.at("ticks"), json("server.json").at("ticks"));
    EXPECT_THAT(full.at("recording").at("error").get<std::string>(), HasSubstr("File too large"));
    EXPECT_EQ(full.at("recording").at("file"), file("a.part.pcap"));
    EXPECT_EQ(info("a.part.pcap").at("frames"), full.at("recording").at("frames"));
    EXPECT_FALSE(info("a.part.pcap").at("ends_with_goodbye"));

    const Finished too_little = record_on_disk_of(1, "b.pcap", "none.json");
    EXPECT_EQ(too_little.status, 1);
    // The block is solid bone; the first line says so.
    const auto last_line = [](const std::string& err) {
        return err.substr(err.find("haptic_server: /", err.find("all of it is bone\n")));
    };
    const std::string line = last_line(too_little.err);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << too_little.err;
    const Finished no_room = run_program(
        {HAPTIC_SERVER, "--bone", file("block.nrrd"), "--clock", "virtual", "--record", "/dev/full"});
    EXPECT_EQ(no_room.status, 1);
    EXPECT_EQ(last_line(no_room.err),
              "haptic_server: /dev/full: cannot write the recording: No space left on device\n");
}

TEST_F(Recording, IsCutAndJoinedByWiresharksTools) {
    for (const char* tool : {"/usr/bin/editcap", "/usr/bin/mergecap"})
        if (!std::filesystem::exists(tool)) GTEST_SKIP() << tool << " is not installed";
    record("a.pcap");
    const int frames = info("a.pcap").at("frames").get<int>() - 20;
    ASSERT_EQ(run_program({"/usr/bin/editcap", "-r", file("a.pcap"), file("cut.pcapng"),
                           "1-" + std::to_string(frames)})
                  .status,
              0);
    EXPECT_EQ(info("cut.pcapng").at("frames"), frames);
    ASSERT_EQ(
        run_program({"/usr/bin/mergecap", "-a", "-w", file("both.pcapng"), file("a.pcap"), file("a.pcap")})
            .status,
        0);
    const auto both = info("both.pcapng");
    EXPECT_EQ(both.at("sessions"), 2);
    EXPECT_EQ(both.at("bone_checksum"), json("server.json").at("bone_checksum"));
}

TEST_F(Recording, IsDecodedByTsharkWithOurProtoFiles) {
    if (!std::filesystem::exists("/usr/bin/tshark")) GTEST_SKIP() << "tshark is not installed";
    record("a.pcap");
    const Finished tshark = run_program({"/usr/bin/tshark", "-r", file("a.pcap"), "-X",
                                         "lua_script:" REPOSITORY "/proto/osteomill.lua", "-o",
                                         "uat:protobuf_search_paths:\"" REPOSITORY "/proto\",\"TRUE\"",
                                         "-V"});
    EXPECT_EQ(tshark.status, 0) << tshark.err;
    EXPECT_THAT(tshark.out, AllOf(HasSubstr("scene_name = block"), HasSubstr("removed_mm3 = "),
                                  HasSubstr("zstd_channels"), HasSubstr("the session has ended")));
}

TEST_F(Recording, IsNotWhatJustAnyFileIs) {
    std::ofstream(file("text.pcap")) << "no capture at all, but some text";
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{PACKET_REPLAY, file("text.pcap")},
          {PACKET_REPLAY, file("none.pcap"), "--info"},
          {RENDER_CLIENT, "--offscreen", "--replay", file("text.pcap")}}) {
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, 1) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_THAT(run.err, HasSubstr(".pcap: "));
    }
    EXPECT_EQ(run_program({PACKET_REPLAY}).status, 2);
    EXPECT_EQ(run_program({PACKET_REPLAY, "--help"}).status, 0);
    EXPECT_THAT(run_program({PACKET_REPLAY, "--version"}).out, HasSubstr(OSTEOMILL_VERSION));
    EXPECT_EQ(run_program({RENDER_CLIENT, "--replay", "a.pcap", "--connect", "127.0.0.1:7010"}).status, 2);
    EXPECT_EQ(run_program({RENDER_CLIENT, "--speed", "2"}).status, 2);
}

}  // namespace
}  // namespace osteomill::testing
