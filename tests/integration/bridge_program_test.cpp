// haptic_server and an arm in a process of its own, and failures of either.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/logged_removal.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

using Command = std::vector<std::string>;

class BridgePrograms : public ::testing::Test {
  protected:
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    std::string socket() const { return "unix:" + file("arm"); }
    Command server(const std::string& seconds, const Command& more = {}) const {
        Command command{HAPTIC_SERVER,    "--device",  "bridge",          "--scene",  "cube",
                        "--listen",       "none",      "--duration-s",    seconds,    "--json",
                        file("run.json"), "--log-csv", file("force.csv"), "--bridge", socket()};
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }
    Command arm(const std::string& seconds, const std::string& key = {}) const {
        return {SIMULATED_ARM, socket(), key, seconds};
    }
    double removed_mm3() const { return logged_removal_mm3(folder_ / "force.part.csv"); }
    bool has_removed(double least_mm3) const {
        return testing::has_removed(folder_ / "force.part.csv", least_mm3);
    }
    nlohmann::json measured() const {
        std::ifstream in(file("run.json"));
        return nlohmann::json::parse(in);
    }
    /// The number before `unit` in an arm's last output.
    static double told(const std::string& text, const std::string& what) {
        std::smatch match;
        EXPECT_TRUE(std::regex_search(text, match, std::regex(what + " ([0-9.]+) N"))) << text;
        return match.empty() ? 1e9 : std::stod(match[1]);
    }

    /// The largest change between two exchanges that osteomill_bridge.h allows, however busy the machine is.
    static void expect_no_jump(const std::string& said) {
        EXPECT_LE(told(said, "largest jump"), 2.0) << "1000 N/s, of a loop that is two ticks late at most";
        EXPECT_LE(told(said, "while it goes"), 0.28) << "3.3 N in 12 ms";
    }

    TemporaryFolder folder_;
};

TEST_F(BridgePrograms, AnArmMillsAndFeels) {
    ChildProcess running(server("600"));
    ASSERT_TRUE(running.line_after("waiting for an arm at unix:"));
    ChildProcess hand(arm("600"));
    ASSERT_TRUE(running.line_after("arm simulated arm has joined: 3.3 N, 50 g; "));
    EXPECT_TRUE(has_removed(1.0)) << running.err();
    running.send_signal(SIGINT);
    ASSERT_EQ(running.wait(), 0) << running.err();
    hand.send_signal(SIGINT);
    EXPECT_EQ(hand.wait(), 0) << hand.err();
    EXPECT_GT(told(hand.out(), "largest force"), 0.2);
    expect_no_jump(hand.out());
    EXPECT_GT(measured().at("removed_mm3").at("total").get<double>(), 1.0);
    EXPECT_EQ(measured().at("settings").at("device"), "bridge");
}

TEST_F(BridgePrograms, AnArmThatIsKilledTurnsAllOffAndItsSuccessorGoesOn) {
    ChildProcess running(server("600"));
    ASSERT_TRUE(running.line_after("waiting for an arm at"));
    {
        ChildProcess killed(arm("600"));
        ASSERT_TRUE(running.line_after("arm simulated arm has joined"));
        ASSERT_TRUE(has_removed(0.1)) << running.err();
        killed.send_signal(SIGKILL);
        killed.wait();
    }
    ASSERT_TRUE(has_logged(running, device_lost)) << running.err();
    const double before_mm3 = removed_mm3();
    ChildProcess hand(arm("600"));
    EXPECT_TRUE(has_removed(before_mm3 + 0.5)) << running.err();
    hand.send_signal(SIGINT);
    EXPECT_EQ(hand.wait(), 0) << hand.err();
    EXPECT_TRUE(has_logged(running, device_lost, 2)) << running.err();
    running.send_signal(SIGINT);
    ASSERT_EQ(running.wait(), 0) << running.err();
    expect_no_jump(hand.out());
    EXPECT_GT(told(hand.out(), "largest force"), 0.05) << "it feels again";
    EXPECT_EQ(count(running.err(), device_lost), measured().at("faults").at("device_lost"))
        << "each is logged once";
}

TEST_F(BridgePrograms, AServerThatStandsStillTakesTheForceAwayWithoutAJump) {
    ChildProcess running(server("600"));
    ASSERT_TRUE(running.line_after("waiting for an arm at"));
    ChildProcess hand(arm("600"));
    ASSERT_TRUE(running.line_after("arm simulated arm has joined"));
    ASSERT_TRUE(has_removed(0.1)) << running.err();
    const double before_mm3 = removed_mm3();
    running.send_signal(SIGSTOP);
    std::this_thread::sleep_for(1s);  // longer than an arm holds a force that nobody renews
    running.send_signal(SIGCONT);
    EXPECT_TRUE(has_removed(before_mm3 + 0.1)) << running.err();
    hand.send_signal(SIGINT);
    ASSERT_EQ(hand.wait(), 0) << hand.err();
    running.send_signal(SIGINT);
    ASSERT_EQ(running.wait(), 0) << running.err();
    expect_no_jump(hand.out());
}

TEST_F(BridgePrograms, WithAnotherKeyNobodyJoins) {
    std::ofstream(file("key")) << std::string(40, 'k');
    std::ofstream(file("other")) << std::string(40, 'o');
    for (const char* key : {"key", "other"})
        std::filesystem::permissions(file(key), std::filesystem::perms::owner_read);
    ChildProcess running(server("2", {"--bridge-key", file("key")}));
    ASSERT_TRUE(running.line_after("waiting for an arm at"));
    const Finished stranger = run_program(arm("1", file("other")));
    EXPECT_EQ(stranger.status, 1);
    ASSERT_TRUE(running.line_after("no arm is heard; what comes has another key, version or session"));
    ChildProcess member(arm("600", file("key")));
    ASSERT_EQ(running.wait(), 0) << running.err();
    member.send_signal(SIGINT);
    EXPECT_EQ(member.wait(), 0);
}

TEST_F(BridgePrograms, StopsOnASignalWhileItWaits) {
    ChildProcess running(server("2"));
    ASSERT_TRUE(running.line_after("waiting for an arm at"));
    running.send_signal(SIGINT);
    EXPECT_EQ(running.wait(), 0) << running.err();
    EXPECT_FALSE(std::filesystem::exists(folder_ / "arm"));
}

TEST_F(BridgePrograms, SaysInOneLineWhatIsWrong) {
    std::ofstream(file("open")) << std::string(40, 'k');
    std::filesystem::permissions(file("open"), std::filesystem::perms(0644));
    for (const auto& [more, status, words] :
         {std::tuple(Command{"--device", "bridge", "--bridge", "udp:0.0.0.0:7020"}, 2, "needs --bridge-key"),
          std::tuple(Command{"--device", "bridge", "--bridge", "here"}, 2, "--bridge: 'here' is no address"),
          std::tuple(Command{"--bridge", "unix:/tmp/a"}, 2, "--bridge: goes with --device bridge"),
          std::tuple(Command{"--device", "bridge", "--clock", "virtual"}, 2, "--clock"),
          std::tuple(Command{"--device", "bridge", "--bridge-key", "/nowhere"}, 1,
                     "/nowhere: cannot be read"),
          std::tuple(Command{"--device", "bridge", "--bridge-key", file("open")}, 1,
                     "open: is a key of the bridge that others may read"),
          std::tuple(Command{"--device", "bridge", "--bridge", "unix:/nowhere/arm"}, 1,
                     "no socket can be made")}) {
        Command command{HAPTIC_SERVER, "--listen", "none"};
        command.insert(command.end(), more.begin(), more.end());
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, status) << words;
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(count(run.err, "\n"), 1) << run.err;
    }
}

}  // namespace
}  // namespace osteomill::testing
