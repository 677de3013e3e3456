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

TEST_F(OutputFiles, OfAnImportAreNeverTheScan) {
    const auto import = [&](const Command& options) {
        Command command{BONE_IMPORT};
        command.insert(command.end(), options.begin(), options.end());
        return command;
    };
    const std::string scan = text("block.nrrd");
    fs::create_symlink(".", file("link"));
    fs::create_hard_link(file("block.nrrd"), file("hard.nrrd"));
    for (const std::string& same : {file("block.nrrd"), file("link/block.nrrd"), file("hard.nrrd")}) {
        expect_refused(import({file("block.nrrd"), same, "--spacing-mm", "1"}), "INPUT", "OUTPUT");
        expect_refused(import({file("block.nrrd"), "--preview", same}), "INPUT", "--preview");
    }
    fs::create_directories(file("stack"));
    fs::copy_file(file("block.nrrd"), file("stack/1.nrrd"));
    for (const std::string name : {"stack/1.nrrd", "stack/new.nrrd", "link/stack/new.nrrd"})
        expect_refused(import({file("stack"), file(name)}), "INPUT", "OUTPUT");
    expect_refused(import({file("stack"), "--case", file("stack")}), "INPUT", "--case");
    fs::create_directory(file("case"));
    fs::copy_file(file("block.nrrd"), file("case/bone.nrrd"));
    expect_refused(import({file("case/bone.nrrd"), "--case", file("case")}), "INPUT", "--case");
    // The voxels of a header that names their file are read, too.
    put("scan.nhdr",
        "NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\nendian: little\n"
        "data file: voxels.raw\n\n");
    put("voxels.raw", std::string(128, 'x'));
    expect_refused(import({file("scan.nhdr"), "--preview", file("voxels.raw")}), "INPUT", "--preview");
    fs::create_symlink("nowhere.nrrd", file("dangling.nrrd"));
    expect_refused(import({file("block.nrrd"), file("dangling.nrrd")}), "dangling.nrrd", "nowhere.nrrd");
    EXPECT_EQ(text("block.nrrd"), scan);
    EXPECT_EQ(text("voxels.raw"), std::string(128, 'x'));
    EXPECT_TRUE(fs::is_symlink(file("dangling.nrrd")));
}

TEST_F(OutputFiles, OfASessionAreNoneThatItsCaseOrSceneIsMadeOf) {
    fs::create_directory(file("case"));
    fs::copy_file(file("block.nrrd"), file("case/bone.nrrd"));
    fs::copy_file(file("block.nrrd"), file("case/scan.nrrd"));
    const std::string scan = text("block.nrrd");
    const auto session = [&](const std::string& option, const std::string& path, const Command& of) {
        Command command{HAPTIC_SERVER, "--clock", "virtual", "--duration-s", "0.01", option, path};
        command.insert(command.end(), of.begin(), of.end());
        return command;
    };
    put("case/case.toml", "name = \"x\"\n[bone]\nfile = \"bone.nrrd\"\n");
    for (const std::string option : {"--record", "--save-bone", "--json", "--log-csv"}) {
        expect_refused(session(option, file("case/bone.nrrd"), {"--case", file("case")}), "--case", option);
        const Finished scene =
            run_program(session(option, file("case/bone.nrrd"), {"--scene", file("case/case.toml")}));
        EXPECT_NE(scene.status, 0) << option;
        EXPECT_THAT(scene.err, HasSubstr("are the same file")) << option;
    }
    put("case/case.toml", "name = \"x\"\n[bone]\nfile = \"scan.nrrd\"\n");
    const Finished own = run_program(session("--record", file("case/scan.nrrd"), {"--case", file("case")}));
    EXPECT_EQ(own.status, 1);
    EXPECT_THAT(own.err, HasSubstr("are the same file"));
    expect_refused(session("--record", file("case/placement.toml"), {"--case", file("case")}), "--case",
                   "--record");
    EXPECT_EQ(text("case/bone.nrrd"), scan);
    EXPECT_EQ(text("case/scan.nrrd"), scan);
}

TEST_F(OutputFiles, ThatALinkToNothingNamesAreRefused) {
    fs::create_symlink("nowhere.nrrd", file("dangling.nrrd"));
    for (const std::string option : {"--save-bone", "--json", "--record"})
        expect_refused(server({"--duration-s", "0.2", option, file("dangling.nrrd")}), option,
                       "nowhere.nrrd");
    EXPECT_TRUE(fs::is_symlink(file("dangling.nrrd")));
    EXPECT_FALSE(fs::exists(file("nowhere.nrrd")));
}

TEST_F(OutputFiles, OfPicturesAreNoneThatIsReplayed) {
    fs::create_directory(file("shots"));
    put("shots/final.png", "a recording");
    expect_refused(
        {RENDER_CLIENT, "--offscreen", "--replay", file("shots/final.png"), "--screenshots", file("shots")},
        "--replay", "--screenshots");
    put("shots/dataset.json", "a recording");
    expect_refused({RENDER_CLIENT, "--replay", file("shots/dataset.json"), "--dataset", file("shots")},
                   "--replay", "--dataset");
}

TEST_F(OutputFiles, AreOneSessionsFromItsStart) {
    ChildProcess first(
        server({"--listen", "127.0.0.1:0", "--save-bone", file("a.nrrd"), "--json", file("a.json")}));
    ASSERT_TRUE(first.line_after("listening on"));
    for (const Command& output : {Command{"--save-bone", file("a.nrrd")}, {"--json", file("a.json")}}) {
        const Finished second =
            run_program(server({"--clock", "virtual", "--duration-s", "0.1", output.front(), output.back()}));
        EXPECT_EQ(second.status, 1) << second.err;
        EXPECT_THAT(second.err, AllOf(HasSubstr(output.back()), HasSubstr("another session will write it")));
    }
    first.send_signal(SIGKILL);
    ASSERT_EQ(first.wait(), 128 + SIGKILL);
    const Finished next =
        run_program(server({"--clock", "virtual", "--duration-s", "0.1", "--save-bone", file("a.nrrd")}));
    EXPECT_EQ(next.status, 0) << next.err;
    EXPECT_FALSE(fs::exists(file(".a.nrrd.lock")));
}

TEST_F(OutputFiles, WhoseFolderIsRemovedAreElsewhereAndThatIsSaidAtOnce) {
    for (const bool is_renamed : {false, true}) {
        fs::create_directory(file("lab"));
        ChildProcess session(server({"--listen", "127.0.0.1:0", "--save-bone", file("lab/a.nrrd")}));
        ASSERT_TRUE(session.line_after("listening on"));
        if (is_renamed)
            fs::rename(file("lab"), file("moved"));
        else
            fs::remove_all(file("lab"));
        const std::string place = file(is_renamed ? "moved/a.nrrd" : "lab.rescued/a.nrrd");
        EXPECT_TRUE(eventually([&] {
            session.read_output();
            return session.err().find("it will be " + place) != std::string::npos;
        })) << session.err();
        session.send_signal(SIGTERM);
        EXPECT_EQ(session.wait(), 0) << session.err();
        EXPECT_TRUE(fs::exists(place));
        EXPECT_EQ(run_program({BONE_EXPORT, place, file("a.stl")}).status, 0);
    }
}

TEST_F(OutputFiles, AreAllNamedWhereSeveralCannotBeWritten) {
    ChildProcess session(server({"--listen", "127.0.0.1:0", "--save-bone", file("a.nrrd"), "--json",
                                 file("a.json"), "--record", file("a.pcap")}));
    ASSERT_TRUE(session.line_after("listening on"));
    for (const std::string name : {"a.nrrd", "a.json", "a.pcap"}) fs::create_directory(file(name));
    session.send_signal(SIGTERM);
    EXPECT_EQ(session.wait(), 1);
    EXPECT_THAT(session.err(),
                AllOf(HasSubstr(file("a.nrrd") + ": "), HasSubstr(file("a.json") + ": "),
                      HasSubstr("lies in " + file("a.part.pcap") + ", which packet_replay reads")));
    EXPECT_EQ(run_program({PACKET_REPLAY, file("a.part.pcap"), "--info"}).status, 0);
}

TEST_F(OutputFiles, WhoseSourceIsWrittenOverAreSavedAndThatIsSaidAtOnce) {
    ASSERT_EQ(
        run_program(server({"--clock", "virtual", "--duration-s", "0.1", "--save-bone", file("carved.nrrd")}))
            .status,
        0);
    ChildProcess session({HAPTIC_SERVER, "--bone", file("carved.nrrd"), "--listen", "127.0.0.1:0",
                          "--save-bone", file("a.nrrd")});
    ASSERT_TRUE(session.line_after("listening on"));
    fs::resize_file(file("carved.nrrd"), 1000);
    EXPECT_TRUE(eventually([&] {
        session.read_output();
        return session.err().find("carved.nrrd: was written to since it was loaded") != std::string::npos;
    })) << session.err();
    session.send_signal(SIGTERM);
    EXPECT_EQ(session.wait(), 1);
    EXPECT_THAT(session.err(), HasSubstr("is saved with CT numbers that only say where bone is left"));
    EXPECT_EQ(run_program({BONE_EXPORT, file("a.nrrd"), file("a.stl")}).status, 0);
}

}  // namespace
}  // namespace osteomill::testing
