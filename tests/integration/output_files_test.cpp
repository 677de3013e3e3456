// The files that a session leaves are old or new, never half of either; and no two of them are one. The real
// programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/folder_test.h"
#include "tests/support/force_log_file.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using Command = std::vector<std::string>;
using ::testing::AllOf;
using ::testing::HasSubstr;

class OutputFiles : public FolderTest {
  protected:
    OutputFiles() { write_block(file("block.nrrd")); }

    void put(const std::string& name, const std::string& text = "old") const {
        std::ofstream(file(name)) << text;
    }
    Command server(const Command& options) const {
        Command command{HAPTIC_SERVER, "--bone", file("block.nrrd")};
        command.insert(command.end(), options.begin(), options.end());
        return command;
    }
    /// In a shell where files may have so many KiB: a full disk.
    static Finished run_on_disk_of(int kibibytes, const Command& command) {
        std::string line = "ulimit -f " + std::to_string(kibibytes) + "; exec";
        for (const std::string& word : command) line += " " + word;
        return run_program({"/bin/bash", "-c", line});
    }
    void expect_refused(const Command& command, const std::string& one, const std::string& other) const {
        const Finished run = run_program(command);
        EXPECT_EQ(run.status, 2) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_THAT(run.err, AllOf(HasSubstr(one), HasSubstr(other)));
    }
};

TEST_F(OutputFiles, OfAKilledSessionLeaveTheOldOnesAsTheyWere) {
    const Command names{"a.json", "force.csv", "milling.csv", "a.pcap"};
    for (const std::string& name : names) put(name);
    {
        ChildProcess session(
            server({"--listen", "none", "--json", file("a.json"), "--log-csv", file("force.csv"),
                    "--log-milling-csv", file("milling.csv"), "--record", file("a.pcap")}));
        ASSERT_TRUE(eventually([&] {
            return fs::exists(file("force.part.csv")) && fs::file_size(file("force.part.csv")) > 10'000;
        }));
        session.send_signal(SIGKILL);
        ASSERT_EQ(session.wait(), 128 + SIGKILL);
    }
    for (const std::string& name : names) EXPECT_EQ(text(name), "old") << name;
    EXPECT_EQ(run_program({PACKET_REPLAY, file("a.part.pcap"), "--info"}).status, 0);
    const auto torn_bytes = fs::file_size(file("force.part.csv"));

    const Finished next =
        run_program(server({"--clock", "virtual", "--duration-s", "0.2", "--json", file("a.json"),
                            "--log-csv", file("force.csv"), "--record", file("a.pcap")}));
    ASSERT_EQ(next.status, 0) << next.err;
    EXPECT_THAT(next.err, AllOf(HasSubstr("force.torn-1.csv"), HasSubstr("a.torn-1.pcap")));
    EXPECT_EQ(fs::file_size(file("force.torn-1.csv")), torn_bytes);
    EXPECT_EQ(run_program({PACKET_REPLAY, file("a.torn-1.pcap"), "--info"}).status, 0);
    EXPECT_EQ(read_force_log(file("force.csv")).size(), 201U);
    EXPECT_EQ(run_program({PACKET_REPLAY, file("a.pcap"), "--info"}).status, 0);
    EXPECT_FALSE(fs::exists(file("force.part.csv")));
}

TEST_F(OutputFiles, OnAFullDiskLeaveTheOldOnesAsTheyWere) {
    for (const std::string name : {"a.json", "force.csv"}) put(name);
    const Finished session = run_on_disk_of(1, server({"--clock", "virtual", "--duration-s", "1", "--json",
                                                       file("a.json"), "--log-csv", file("force.csv")}));
    EXPECT_EQ(session.status, 1);
    EXPECT_THAT(session.err, AllOf(HasSubstr("force.csv: the log is not complete: File too large"),
                                   HasSubstr("force.part.csv\n")));
    EXPECT_EQ(text("a.json"), "old");
    EXPECT_EQ(text("force.csv"), "old");
    EXPECT_EQ(fs::file_size(file("force.part.csv")), 1024U);

    ASSERT_EQ(
        run_program(server({"--clock", "virtual", "--duration-s", "1", "--record", file("a.pcap")})).status,
        0);
    for (const std::string name : {"b.json", "b.csv"}) put(name);
    for (const Command& output : {Command{"--json", file("b.json")}, {"--csv", file("b.csv")}}) {
        const Finished replay =
            run_on_disk_of(1, {PACKET_REPLAY, file("a.pcap"), output.front(), output.back()});
        EXPECT_EQ(replay.status, 1) << replay.err;
    }
    EXPECT_EQ(text("b.json"), "old");
    EXPECT_EQ(text("b.csv"), "old");
    EXPECT_FALSE(fs::exists(file("b.part.csv")));
}

TEST_F(OutputFiles, ThatCannotBeWrittenAreRefusedAtTheStart) {
    fs::create_directory(file("folder.nrrd"));
    for (const std::string name : {"--json", "--save-bone"})
        for (const std::string& place :
             {file("folder.nrrd"), file(std::string(250, 'n') + ".nrrd"), std::string("/proc/x.nrrd")}) {
            const Finished session =
                run_program(server({"--clock", "virtual", "--duration-s", "1000000", name, place}));
            EXPECT_EQ(session.status, 1) << session.err;
            EXPECT_THAT(session.err, HasSubstr(place)) << "and no session is run";
        }
    EXPECT_TRUE(fs::is_empty(file("folder.nrrd")));
}

TEST_F(OutputFiles, AreRefusedAtTheStartWhereTwoAreOne) {
    put("a.csv");
    fs::create_symlink("a.csv", file("link.csv"));
    fs::create_hard_link(file("a.csv"), file("hard.csv"));
    for (const std::string& same : {file("a.csv"), file("./a.csv"), file("link.csv"), file("hard.csv")})
        expect_refused(server({"--duration-s", "0.2", "--json", same, "--log-csv", file("a.csv")}), "--json",
                       "--log-csv");
    expect_refused(server({"--duration-s", "0.2", "--record", file("new"), "--log-milling-csv", file("new")}),
                   "--record", "--log-milling-csv");
    expect_refused(
        server({"--duration-s", "0.2", "--json", file("new.nrrd"), "--save-bone", file("new.nrrd")}),
        "--json", "--save-bone");
    EXPECT_EQ(text("a.csv"), "old");
    EXPECT_EQ(run_program(server({"--clock", "virtual", "--duration-s", "0.1", "--json", "/dev/null",
                                  "--log-csv", "/dev/null"}))
                  .status,
              0);
}

TEST_F(OutputFiles, AreRefusedWhereTheyWouldDestroyWhatIsRead) {
    put("motion.csv", "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,0,0,6,0,0,1,0\n0.2,0,0,6,0,0,1,0\n");
    expect_refused(
        server({"--duration-s", "0.2", "--trajectory", file("motion.csv"), "--log-csv", file("motion.csv")}),
        "--trajectory", "--log-csv");
    expect_refused(server({"--duration-s", "0.2", "--json", file("block.nrrd")}), "--bone", "--json");
    ASSERT_EQ(
        run_program(server({"--clock", "virtual", "--duration-s", "0.1", "--record", file("a.pcap")})).status,
        0);
    expect_refused({PACKET_REPLAY, file("a.pcap"), "--csv", file("a.pcap")}, "FILE", "--csv");
    expect_refused({PACKET_REPLAY, file("a.pcap"), "--json", file("b"), "--csv", file("b")}, "--json",
                   "--csv");
    expect_refused({RENDER_CLIENT, "--offscreen", "--replay", file("a.pcap"), "--json", file("a.pcap")},
                   "--replay", "--json");
    EXPECT_EQ(run_program({PACKET_REPLAY, file("a.pcap"), "--info"}).status, 0) << "it is still there";

    // A bone is taken up and saved under its own name every day.
    const Finished again = run_program(server(
        {"--trajectory", file("motion.csv"), "--clock", "virtual", "--save-bone", file("block.nrrd")}));
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(run_program(server({"--trajectory", file("motion.csv"), "--clock", "virtual"})).status, 0);
}

TEST_F(OutputFiles, AreRefusedWhereTheyWouldDestroyAKeyOrACertificate) {
    const Command tls{"--tls-cert", file("own.pem"), "--tls-key", file("key.pem"),
                      "--tls-ca",   file("ca.pem"),  "--tls-crl", file("crl.pem")};
    for (const std::string name : {"own.pem", "key.pem", "ca.pem", "crl.pem", "a.pcap"}) put(name);
    const auto with = [&](Command command, const Command& more) {
        command.insert(command.end(), tls.begin(), tls.end());
        command.insert(command.end(), more.begin(), more.end());
        return command;
    };
    for (std::size_t i = 0; i < tls.size(); i += 2) {
        const std::string& option = tls[i];
        const std::string& path = tls[i + 1];
        expect_refused(with(server({}), {"--json", path}), option, "--json");
        expect_refused(with(server({"--listen", "none"}), {"--log-csv", path}), option, "--log-csv");
        expect_refused(with({PACKET_REPLAY, file("a.pcap")}, {"--csv", path}), option, "--csv");
        expect_refused(with({RENDER_CLIENT, "--offscreen"}, {"--record", path}), option, "--record");
    }
    EXPECT_EQ(text("key.pem"), "old");
}

}  // namespace
}  // namespace osteomill::testing
