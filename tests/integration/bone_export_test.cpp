// Exports: a session's bone as a surface that another program opens, and the removed part of it.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/folder_test.h"
#include "tests/support/milling_motion.h"

namespace osteomill {
namespace {

using testing::Finished;
using ::testing::HasSubstr;
using testing::run_program;

class BoneExport : public testing::FolderTest {
  protected:
    /// A block, drilled for a while.
    Finished drill(const std::string& duration_s, const std::vector<std::string>& more) const {
        testing::write_block(file("block.nrrd"));
        testing::write_milling_motion(file("motion.csv"));
        std::vector<std::string> command{HAPTIC_SERVER,  "--bone",           file("block.nrrd"),
                                         "--trajectory", file("motion.csv"), "--clock",
                                         "virtual",      "--duration-s",     duration_s};
        command.insert(command.end(), more.begin(), more.end());
        return run_program(command);
    }
    double removed_mm3() const { return json("a.json").at("removed_mm3").at("total"); }
};

TEST_F(BoneExport, GivesTheSameSurfaceOfTheSavedBoneAndOfTheRecording) {
    const Finished drilled = drill(
        "2", {"--record", file("a.pcap"), "--save-bone", file("carved.nrrd"), "--json", file("a.json")});
    ASSERT_EQ(drilled.status, 0) << drilled.err;
    const Finished exported = run_program({BONE_EXPORT, file("carved.nrrd"), file("a.stl")});
    EXPECT_EQ(exported.status, 0) << exported.err;
    EXPECT_THAT(exported.err, HasSubstr("triangles"));
    const Finished replayed = run_program({PACKET_REPLAY, file("a.pcap"), "--surface", file("b.stl"),
                                           "--difference", file("gone.nrrd"), "--json", file("b.json")});
    EXPECT_EQ(replayed.status, 0) << replayed.err;
    EXPECT_EQ(text("a.stl"), text("b.stl"));
    EXPECT_TRUE(std::filesystem::exists(file("b.json")));

    // A bone saved at once is the one that was drilled.
    const Finished whole = drill("0.001", {"--save-bone", file("whole.nrrd")});
    ASSERT_EQ(whole.status, 0) << whole.err;
    const Finished gone =
        run_program({BONE_EXPORT, file("carved.nrrd"), file("gone2.nrrd"), "--removed", file("whole.nrrd")});
    EXPECT_EQ(gone.status, 0) << gone.err;
    EXPECT_EQ(text("gone.nrrd"), text("gone2.nrrd"));
    std::smatch volume;
    ASSERT_TRUE(std::regex_search(gone.err, volume, std::regex("([0-9.]+) mm\\^3 removed"))) << gone.err;
    EXPECT_NEAR(std::stod(volume[1]), removed_mm3(), 1e-3);
    EXPECT_GT(removed_mm3(), 0.01);

    // Another program finds it closed.
    if (run_program({"/bin/sh", "-c", "command -v admesh"}).status != 0) GTEST_SKIP() << "there is no admesh";
    const Finished checked = run_program({"/usr/bin/env", "admesh", file("a.stl")});
    EXPECT_EQ(checked.status, 0);
    for (const char* line : {"Total disconnected facets *: *0 ", "Degenerate facets *: *0\n",
                             "Backwards edges *: *0\n", "Normals fixed *: *0\n"})
        EXPECT_TRUE(std::regex_search(checked.out, std::regex(line))) << line << checked.out;
    ASSERT_TRUE(std::regex_search(checked.out, volume, std::regex("Volume *: *([-0-9.]+)"))) << checked.out;
    EXPECT_GT(std::stod(volume[1]), 0.0) << "else normals point inwards";
}

TEST_F(BoneExport, ThatIsStoppedLeavesNothingAndSaysSo) {
    const Finished large = run_program({HAPTIC_SERVER, "--scene", "cube", "--clock", "virtual",
                                        "--duration-s", "0.001", "--save-bone", file("cube.nrrd")});
    ASSERT_EQ(large.status, 0) << large.err;
    std::filesystem::create_directory(file("out"));
    bool was_in_time = false;
    // The signal may come before the program listens, or after it is done; then once more.
    for (int attempt = 0; attempt < 20 && !was_in_time; ++attempt) {
        testing::ChildProcess exported({BONE_EXPORT, file("cube.nrrd"), file("out/a.stl")});
        std::this_thread::sleep_for(std::chrono::milliseconds(100 * (attempt + 1)));
        exported.send_signal(attempt % 2 == 0 ? SIGINT : SIGTERM);
        if (exported.wait(std::chrono::seconds(100)) == 1) {
            was_in_time = true;
            EXPECT_EQ(exported.err(), "bone_export: stopped; nothing was written\n");
            EXPECT_TRUE(std::filesystem::is_empty(file("out")));
        }
        std::filesystem::remove(file("out/a.stl"));
    }
    EXPECT_TRUE(was_in_time);
}

TEST_F(BoneExport, SaysInOneLineWhatIsWrong) {
    const Finished missing = run_program({BONE_EXPORT, file("none.nrrd"), file("a.stl")});
    EXPECT_EQ(missing.status, 1);
    EXPECT_THAT(missing.err, HasSubstr("none.nrrd"));
    EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1);
    const Finished wrong = run_program({BONE_EXPORT, file("none.nrrd"), file("a.step")});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, HasSubstr(".stl, .ply or .obj"));
    EXPECT_EQ(run_program({BONE_EXPORT, "--help"}).status, 0);
}

}  // namespace
}  // namespace osteomill
