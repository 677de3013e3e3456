// Input from elsewhere: names, links, paths, endless files, damaged cases, open secrets and absurd numbers,
// given to the real programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common/recording/playhead.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Command = std::vector<std::string>;

constexpr const char* cube_case = "name = \"x\"\n[bone]\nphantom = \"cube\"\n";

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

bool is_fit_for_a_terminal(const std::string& text) {
    return std::ranges::none_of(
        text, [](unsigned char c) { return (c < 0x20 && c != '\n' && c != '\r') || c == 0x7f; });
}

class FromElsewhere : public ::testing::Test {
  protected:
    FromElsewhere() { fs::create_directory(folder_ / "case"); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    /// A session of a few ticks.
    Finished session(const Command& more) const {
        Command command{HAPTIC_SERVER, "--clock", "virtual", "--duration-s", "0.02"};
        command.insert(command.end(), more.begin(), more.end());
        return run_program(command);
    }
    Finished session_of_case(const std::string& toml) const {
        write(folder_ / "case/case.toml", toml);
        return session({"--case", file("case")});
    }
    /// Wrong usage or a failure, with one line that is fit for a terminal.
    static void expect_refused(const Finished& run, const std::string& words) {
        EXPECT_TRUE(run.status == 1 || run.status == 2) << run.status << ' ' << run.err;
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
        EXPECT_TRUE(is_fit_for_a_terminal(run.err)) << run.err;
    }
    /// A label map beside testing::write_block's bone: the segment's voxels are a plate on its top.
    void write_segmentation(const std::string& name_of_segment) const {
        write_block(folder_ / "scan.nrrd");
        std::string text =
            "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 48 40 32\n"
            "space directions: (0.2,0,0) (0,0.2,0) (0,0,0.2)\nspace origin: (-4.7,-3.9,-4.1)\n"
            "encoding: raw\nSegment0_Name:=" +
            name_of_segment + "\nSegment0_LabelValue:=1\nSegment1_Name:=Other\nSegment1_LabelValue:=2\n\n";
        for (int voxel = 0; voxel < 48 * 40 * 32; ++voxel) {
            const int z = voxel / (48 * 40);
            text += z > 27 ? '\1' : z > 24 ? '\2' : '\0';
        }
        write(folder_ / "s.seg.nrrd", text);
    }
    Finished import_case(const Command& more = {}) const {
        Command command{BONE_IMPORT, file("scan.nrrd"), "--case", file("made"),     "--threshold-hu",
                        "300",       "--spacing-mm",    "0.2",    "--segmentation", file("s.seg.nrrd")};
        command.insert(command.end(), more.begin(), more.end());
        return run_program(command);
    }

    TemporaryFolder folder_;
};

TEST_F(FromElsewhere, ArgumentsThatAreNoPlainTextAreRefusedByEachProgram) {
    for (const std::string name : {"Z\xe4hne", "\x1b[2J\nfake line", "a\u202e"})
        for (const Command& command :
             {Command{HAPTIC_SERVER, "--case", file(name)}, Command{HAPTIC_SERVER, "--trainee", name},
              Command{PACKET_REPLAY, file(name), "--info"}, Command{BONE_IMPORT, file(name), file("o.nrrd")},
              Command{RENDER_CLIENT, "--replay", file(name)}})
            expect_refused(run_program(command), "names are UTF-8 without control characters");
}

TEST_F(FromElsewhere, NamesInFilesAreCheckedWhereTheyEnter) {
    for (const std::string escape : {"\\u001b[2J", "\\n", "\\u009b", "\\u2028"})
        for (const std::string& toml :
             {"name = \"" + escape + "\"\n[bone]\nphantom = \"cube\"\n",
              cube_case + ("[[burrs]]\nname = \"" + escape + "\"\ndiameter_mm = 2.0\n")})
            expect_refused(session_of_case(toml), "'name' holds a control character");
    write(folder_ / "c.csv", "t_s,action,text\n0.01,mark,Z\xe4hne\n");
    expect_refused(session({"--scene", "cube", "--controls", file("c.csv")}),
                   "c.csv:2: the text is no UTF-8");
    for (const std::string name : {"Z\xe4hne", "\x1b]0;owned\x07", "two\\nlines"}) {
        write_segmentation(name);
        expect_refused(import_case(), "the name of its segment 0, ");
        EXPECT_FALSE(fs::exists(folder_ / "made/bone.nrrd")) << "refused before its work";
    }
}

TEST_F(FromElsewhere, NamesOfSegmentsAreTakenAsTheyAre) {
    for (const std::string name :
         {"left\\right", "[Other,Nerve]", "{}", "-Other", "--target", "a=b", "=1+1", "%%"}) {
        SCOPED_TRACE(name);
        fs::remove_all(folder_ / "made");
        // In a NRRD a backslash stands twice.
        std::string escaped;
        for (const char letter : name)
            escaped += letter == '\\' ? std::string("\\\\") : std::string(1, letter);
        write_segmentation(escaped);
        const Finished made = import_case({"--protect", name});
        ASSERT_EQ(made.status, 0) << made.err;
        const Finished run = session({"--case", file("made"), "--record", file("r.pcap")});
        ASSERT_EQ(run.status, 0) << run.err;
        Playhead playhead(folder_ / "r.pcap");
        std::set<std::string> guarded;
        for (const Tissue& tissue : playhead.session().tissues)
            if (tissue.is_protected) guarded.insert(tissue.name);
        EXPECT_EQ(guarded, std::set<std::string>{name});
        fs::remove(folder_ / "r.pcap");
    }
}

TEST_F(FromElsewhere, ACellThatASpreadsheetWouldComputeIsText) {
    write_segmentation("=HYPERLINK(1)");
    ASSERT_EQ(import_case({"--protect", "=HYPERLINK(1)"}).status, 0);
    ASSERT_EQ(session({"--case", file("made"), "--report", file("report")}).status, 0);
    const Finished csv =
        run_program({PACKET_REPLAY, file("report/session.pcap"), "--states-csv", file("s.csv")});
    ASSERT_EQ(csv.status, 0) << csv.err;
    for (const std::string& table : {text_of(folder_ / "s.csv"), text_of(folder_ / "report/metrics.csv")}) {
        EXPECT_THAT(table, HasSubstr(",\"'=HYPERLINK(1)\","));
        EXPECT_THAT(table, Not(HasSubstr(",=")));
    }
    EXPECT_THAT(text_of(folder_ / "s.csv"), HasSubstr(",6.1050,")) << "numbers are numbers";
}

TEST_F(FromElsewhere, NothingIsWrittenThroughALinkInAFolder) {
    write(folder_ / "precious", "precious");
    fs::create_directory(folder_ / "report");
    for (const char* name : {"report.part.html", "metrics.part.csv", "session.part.pcap"})
        fs::create_symlink("../precious", folder_ / "report" / name);
    const Finished run = session({"--scene", "cube", "--report", file("report")});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(text_of(folder_ / "precious"), "precious");

    for (const std::string name : {"report.html", "metrics.json"}) {
        fs::create_directory(folder_ / name);
        fs::create_symlink("../precious", folder_ / name / name);
        EXPECT_EQ(run_program({PACKET_REPLAY, file("report/session.pcap"), "--report", file(name)}).status,
                  0);
        EXPECT_EQ(text_of(folder_ / "precious"), "precious");
    }
    fs::create_directory(folder_ / "dangling");
    fs::create_symlink("../made_elsewhere", folder_ / "dangling/session.pcap");
    expect_refused(session({"--scene", "cube", "--report", file("dangling")}), "holds a session already");
    EXPECT_FALSE(fs::exists(folder_ / "made_elsewhere"));

    write_segmentation("Nerve");
    fs::create_directory(folder_ / "made");
    fs::create_symlink("../precious", folder_ / "made/bone.nrrd");
    expect_refused(import_case(), "is a link");
    EXPECT_EQ(text_of(folder_ / "precious"), "precious");
}

TEST_F(FromElsewhere, ACaseReadsNoFileOutsideItsFolder) {
    write_segmentation("Nerve");
    ASSERT_EQ(import_case().status, 0);
    const fs::path made = folder_ / "made";
    ASSERT_EQ(session({"--case", made.string()}).status, 0);
    write(folder_ / "path.csv", "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,0,0,9,0,0,1,0\n");

    const std::string scan = "name = \"x\"\n[bone]\nthreshold_hu = 300\nfile = ";
    for (const std::string& toml :
         {scan + "\"../scan.nrrd\"\n", scan + "\"" + file("scan.nrrd") + "\"\n", scan + "\"link.nrrd\"\n",
          scan + "\"own.nrrd\"\nsegmentation = \"../s.seg.nrrd\"\n",
          cube_case + std::string("[trajectory]\nfile = \"../path.csv\"\n")}) {
        fs::remove_all(folder_ / "case");
        fs::create_directory(folder_ / "case");
        fs::create_symlink("../scan.nrrd", folder_ / "case/link.nrrd");
        fs::copy_file(folder_ / "scan.nrrd", folder_ / "case/own.nrrd");
        const Finished run = session_of_case(toml);
        EXPECT_EQ(run.status, 1) << toml;
        EXPECT_THAT(run.err, HasSubstr("lies outside the folder of the case"));
        // A scene that somebody writes by hand may name any file.
        EXPECT_EQ(session({"--scene", file("case/case.toml")}).status, 0) << toml;
    }
    write(folder_ / "placement.toml", "position_mm = [0, 0, 9]\nspindle_axis = [0, 0, 1]\n");
    fs::create_symlink("../placement.toml", made / "placement.toml");
    EXPECT_THAT(session({"--case", made.string()}).err,
                HasSubstr("placement.toml: is a link that leads out"));
    fs::remove(made / "placement.toml");
    fs::rename(made / "case.toml", folder_ / "other.toml");
    fs::create_symlink("../other.toml", made / "case.toml");
    EXPECT_THAT(session({"--case", made.string()}).err, HasSubstr("is a link that leads out of its folder"));
}

TEST_F(FromElsewhere, ABitThatFlippedInASegmentationMovesNothing) {
    write_segmentation("Nerve");
    ASSERT_EQ(import_case({"--protect", "Nerve"}).status, 0);
    const fs::path made = folder_ / "made/segmentation.seg.nrrd";
    const std::string whole = text_of(made);
    EXPECT_THAT(session({"--case", file("made")}).err, Not(HasSubstr("unsigned")));
    // Some of all bits of the header and the data.
    for (std::size_t bit = 3; bit < 8 * whole.size(); bit += 97) {
        std::string flipped = whole;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
        write(made, flipped);
        const Finished run = session({"--case", file("made")});
        if (run.status == 0) {
            EXPECT_THAT(run.err, HasSubstr("unsigned: segmentation.seg.nrrd (no digest)")) << "bit " << bit;
        }
    }
}

TEST_F(FromElsewhere, WhatWasEditedOnPurposeIsSaidToBeUnsigned) {
    write_segmentation("Nerve");
    ASSERT_EQ(import_case().status, 0);
    const fs::path scene = folder_ / "made/case.toml";
    std::string toml = text_of(scene);
    const std::string name = "name = \"Nerve\"\n";
    ASSERT_NE(toml.find(name), std::string::npos) << toml;
    toml.insert(toml.find(name) + name.size(), "protected = true\n");
    write(scene, toml);
    Finished run = session({"--case", file("made")});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.err, HasSubstr("unsigned: case.toml (edited since it was written)"));

    const fs::path made = folder_ / "made/segmentation.seg.nrrd";
    std::string segmentation = text_of(made);
    const std::size_t key = segmentation.find("osteomill_digest:=");
    segmentation.erase(key, segmentation.find('\n', key) + 1 - key);
    write(made, segmentation);
    run = session({"--case", file("made")});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("segmentation.seg.nrrd (no digest); damage"));
}

TEST_F(FromElsewhere, EndlessFilesAreRefusedWhoeverNamesThem) {
    ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo(file("pipe.toml").c_str(), 0600), 0);
    write(folder_ / "sparse", "t_s,action,text\n");
    fs::resize_file(folder_ / "sparse", std::uintmax_t{3} << 30U);
    for (const std::string& endless : {std::string("/dev/zero"), file("pipe"), file("sparse")})
        for (const Command& command :
             {Command{HAPTIC_SERVER, "--scene", "cube", "--trajectory", endless},
              Command{HAPTIC_SERVER, "--scene", "cube", "--controls", endless},
              Command{HAPTIC_SERVER, "--scene", endless},
              Command{HAPTIC_SERVER, "--device", "bridge", "--bridge-key", endless},
              Command{HAPTIC_SERVER, "--device", "client", "--operators", endless, "--tls-cert", endless,
                      "--tls-key", endless, "--tls-ca", endless},
              Command{PACKET_REPLAY, endless, "--info"}, Command{BONE_IMPORT, endless, file("o.nrrd")},
              Command{RENDER_CLIENT, "--offscreen", "--connect", "127.0.0.1:1", "--tls-cert", endless,
                      "--tls-key", endless, "--tls-ca", endless}}) {
            SCOPED_TRACE(command[1] + " " + endless);
            expect_refused(run_program(command), endless);
        }
    expect_refused(
        run_program({HAPTIC_SERVER, "--device", "tracker", "--tracker-registration", file("pipe.toml")}),
        "cannot be read");
    expect_refused(run_program({HAPTIC_SERVER, "--device", "hid", "--device-profile", file("pipe.toml")}),
                   "cannot be read");
}

TEST_F(FromElsewhere, ASignalEndsWhatIsStillReading) {
    // A bone that takes a while.
    ChildProcess loading({HAPTIC_SERVER, "--scene", "head", "--listen", "none"});
    loading.send_signal(SIGTERM);
    EXPECT_THAT(loading.wait(), ::testing::AnyOf(0, 128 + SIGTERM));
}

TEST_F(FromElsewhere, NumbersOutOfAnySenseAreRefusedWhereTheyEnter) {
    const std::string motion = "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n";
    for (const auto& [line, words] : {std::tuple("0,1e9,0,9,0,0,1,0", "more than 10000 mm from the origin"),
                                      std::tuple("1e9,0,0,9,0,0,1,0", "t_s must be within"),
                                      std::tuple("0,0,0,9,0,0,1e200,0", "a direction")}) {
        write(folder_ / "m.csv", motion + line + "\n");
        expect_refused(session({"--scene", "cube", "--trajectory", file("m.csv")}), words);
    }
    write(folder_ / "case/placement.toml", "position_mm = [0, 0, 1e9]\nspindle_axis = [0, 0, 1]\n");
    expect_refused(session_of_case(cube_case), "'position_mm' lies more than 10000 mm from the origin");
    write(folder_ / "case/placement.toml", "position_mm = [0, 0, 9]\nspindle_axis = [0, 0, 1e200]\n");
    expect_refused(session_of_case(cube_case), "'spindle_axis' has no length");
    fs::remove(folder_ / "case/placement.toml");

    write_block(folder_ / "scan.nrrd");
    const std::string scan = text_of(folder_ / "scan.nrrd");
    for (const auto& [right, wrong] :
         {std::tuple("(-4.7,-3.9,-4.1)", "(-4.7,-3.9,1e9)"),
          std::tuple("(-4.7,-3.9,-4.1)", "(-9999,-3.9,4e4)"),
          std::tuple("(0.2,0,0) (0,0.2,0) (0,0,0.2)", "(99,0,0) (0,99,0) (0,0,999)")}) {
        std::string far = scan;
        far.replace(far.find(right), std::string(right).size(), wrong);
        write(folder_ / "far.nrrd", far);
        expect_refused(session({"--bone", file("far.nrrd")}), "far.nrrd: ");
        expect_refused(run_program({BONE_IMPORT, file("far.nrrd"), file("o.nrrd")}), "far.nrrd: ");
    }
}

}  // namespace
}  // namespace osteomill::testing
