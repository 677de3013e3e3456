// haptic_server and render_client as a lab runs them: two processes, joined by TCP over loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "common/recording/recording_reader.h"
#include "render_client/link/bone_link.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/folder_test.h"
#include "tests/support/logged_removal.h"

namespace osteomill::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Programs : public FolderTest {
  protected:
    /// A motion that drills the tooth at once, down into the crown, across, out again, until a signal ends
    /// it: on a busy machine a tick that is late by 20 ms ends the milling until the burr is lifted, and it
    /// takes some time before a client has joined.
    std::string long_drilling() const {
        const std::string path = file("drilling.csv");
        std::ofstream csv(path);
        csv << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n";
        for (int i = 0; i < 1000; ++i)
            for (const auto& [at_s, place] :
                 {std::pair(0.0, "0.5,0.2,5.5,0,0,1,0"), std::pair(0.4, "0.5,0.2,4.5,0,0,1,1"),
                  std::pair(2.0, "0.5,0.2,2.5,0,0,1,1"), std::pair(3.0, "2.0,0.2,2.5,0,0,1,1"),
                  std::pair(3.4, "2.0,0.2,5.5,0,0,1,0")})
                csv << 4.0 * i + at_s << ',' << place << '\n';
        return path;
    }
    /// Without a log of its ticks: on a machine that busy lines are missing, which is status 1.
    std::vector<std::string> drilling_server() const {
        return {HAPTIC_SERVER,   "--listen", "127.0.0.1:0",      "--trajectory",
                long_drilling(), "--json",   file("server.json")};
    }

    std::vector<std::string> client(const std::string& address, const std::string& json) const {
        // OpenGL drivers leak and are unloaded before the leak checker of an instrumented client looks.
        return {"/usr/bin/env",
                "ASAN_OPTIONS=detect_leaks=0",
                RENDER_CLIENT,
                "--connect",
                address,
                "--offscreen",
                "--window-size",
                "160x120",
                "--frames",
                "100000",
                "--screenshots",
                file("frames-" + json),
                "--screenshot-every",
                "1000",
                "--json",
                file(json)};
    }
};

TEST_F(Programs, AfterASessionTheClientsBoneIsTheServersBitForBit) {
    ChildProcess server(drilling_server());
    const auto address = server.address();
    ASSERT_TRUE(address) << server.err();
    ChildProcess early(client(*address, "early.json"));
    ASSERT_TRUE(has_logged(server, "joined"));
    ChildProcess late(client(*address, "late.json"));  // joins while the first is drawing
    ASSERT_TRUE(has_logged(server, "joined", 2));
    EXPECT_TRUE(has_removed(server, 1.0)) << server.err();
    server.send_signal(SIGINT);
    ASSERT_EQ(server.wait(), 0) << server.err();
    ASSERT_EQ(early.wait(), 0) << early.err();
    ASSERT_EQ(late.wait(), 0) << late.err();

    const auto served = json("server.json");
    for (const char* name : {"early.json", "late.json"}) {
        const auto seen = json(name);
        EXPECT_EQ(seen.at("bone_checksum"), served.at("bone_checksum")) << name;
        EXPECT_EQ(seen.at("checksum_mismatches"), 0) << name;
        EXPECT_GT(seen.at("frames"), 0) << name;
    }
    EXPECT_GT(served.at("removed_mm3").at("total"), 1.0);
    EXPECT_GT(served.at("removed_mm3").at("carious lesion"), 0.5);
    EXPECT_GT(served.at("peak_force_n"), 0.01);
    EXPECT_LE(served.at("peak_force_n"), 3.3);
    EXPECT_GE(served.at("ticks"), 1000);
    for (const char* key : {"p50", "p99", "p999", "max"}) {
        EXPECT_TRUE(served.at("wakeup_latency_us").contains(key));
        EXPECT_TRUE(served.at("milling_step_us").contains(key));
    }
    EXPECT_TRUE(std::filesystem::exists(file("frames-early.json") + "/final.png"));
}

TEST_F(Programs, ASessionsTimeBeginsWhenAClientHasTheBone) {
    ChildProcess server({HAPTIC_SERVER, "--device", "client", "--scene", "cube", "--listen", "127.0.0.1:0",
                         "--wait-for-client", "--duration-s", "0.5", "--json", file("server.json"),
                         "--record", file("a.pcap")});
    const auto port = server.line_after("listening on 127.0.0.1:");
    ASSERT_TRUE(port) << server.err();
    BoneLink link("127.0.0.1", static_cast<std::uint16_t>(std::stoi(*port)));
    LinkUpdate seen;
    const auto has_frames = [&](std::uint64_t count) {
        return eventually([&] {
            seen = link.poll();
            EXPECT_TRUE(!seen.tool || seen.tool->time_s == 0.0) << "nobody has seen the bone";
            return seen.frames >= count;
        });
    };
    // Many more than the session's 15, and no second passes without: the server waits and is not silent.
    ASSERT_TRUE(has_frames(30));
    ASSERT_TRUE(seen.tool);
    const auto drawn = std::chrono::system_clock::now();
    link.send_view(Viewpoint{});
    EXPECT_TRUE(eventually([&] {
        seen = link.poll();
        return seen.tool && seen.tool->time_s > 0.0;
    }));
    ASSERT_EQ(server.wait(), 0) << server.err();
    const double duration_s = json("server.json").at("duration_s");
    EXPECT_NEAR(duration_s, 0.5, 0.05);
    // The recording says when the session began, and has nothing of the time before.
    EXPECT_NEAR(outline_of(file("a.pcap")).duration_s, duration_s, 0.05);
    RecordingReader recording(file("a.pcap"));
    int states = 0;
    while (const auto frame = recording.next()) {
        const auto* state = std::get_if<StateArrived>(&frame->event);
        if (state == nullptr) continue;
        ++states;
        EXPECT_GE(std::chrono::nanoseconds(state->state.tool.taken_unix_ns), drawn.time_since_epoch());
    }
    EXPECT_GT(states, 0);
}

TEST_F(Programs, ASessionThatWaitsForItsClientCanBeEnded) {
    ChildProcess server({HAPTIC_SERVER, "--device", "client", "--scene", "cube", "--listen", "127.0.0.1:0",
                         "--wait-for-client", "--json", file("server.json")});
    ASSERT_TRUE(server.address()) << server.err();
    EXPECT_TRUE(has_logged(server, "the session begins when a client has drawn the bone", 1)) << server.err();
    server.send_signal(SIGINT);
    ASSERT_EQ(server.wait(), 0) << server.err();
    EXPECT_THAT(server.err(), HasSubstr("the session has not begun: no client drew the bone"));
    EXPECT_LT(json("server.json").at("duration_s"), 0.5) << "no longer than it takes to let the hand go";
}

TEST_F(Programs, AClientThatIsKilledDisturbsNobody) {
    ChildProcess server(drilling_server());
    const auto address = server.address();
    ASSERT_TRUE(address) << server.err();
    ChildProcess steady(client(*address, "steady.json"));
    {
        ChildProcess killed(client(*address, "killed.json"));
        ASSERT_TRUE(has_logged(server, "joined", 2)) << killed.err();
    }
    EXPECT_TRUE(has_removed(server, 0.1)) << server.err();
    server.send_signal(SIGINT);
    ASSERT_EQ(server.wait(), 0) << server.err();
    ASSERT_EQ(steady.wait(), 0) << steady.err();
    EXPECT_EQ(json("steady.json").at("bone_checksum"), json("server.json").at("bone_checksum"));
}

TEST_F(Programs, StopOnSigintCleanlyAndStillReport) {
    ChildProcess server({HAPTIC_SERVER, "--listen", "127.0.0.1:0", "--json", file("server.json")});
    const auto address = server.address();
    ASSERT_TRUE(address) << server.err();
    ChildProcess viewer(client(*address, "client.json"));
    ASSERT_TRUE(has_logged(server, "joined")) << viewer.err();
    viewer.send_signal(SIGINT);
    EXPECT_EQ(viewer.wait(), 0) << viewer.err();
    server.send_signal(SIGINT);
    EXPECT_EQ(server.wait(), 0) << server.err();
    EXPECT_TRUE(json("server.json").contains("bone_checksum"));
    EXPECT_TRUE(json("client.json").contains("gl_renderer"));
}

TEST_F(Programs, AnOffscreenClientSaysThatItWaitsForAServer) {
    ChildProcess waiting(client("127.0.0.1:1", "none.json"));
    EXPECT_TRUE(has_logged(waiting, "waiting for a bone"));
    EXPECT_THAT(waiting.err(), AllOf(HasSubstr("waiting for a bone"), HasSubstr("127.0.0.1:1")));
}

TEST_F(Programs, SayWhatTheyAre) {
    for (const char* program : {HAPTIC_SERVER, RENDER_CLIENT}) {
        EXPECT_EQ(run_program({program, "--help"}).status, 0);
        const Finished version = run_program({program, "--version"});
        EXPECT_EQ(version.status, 0);
        EXPECT_THAT(version.out, HasSubstr(OSTEOMILL_VERSION));
    }
}

}  // namespace
}  // namespace osteomill::testing
