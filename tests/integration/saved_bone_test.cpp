// The files that --save-bone leaves when it is stopped and when the disk is full: the real server saves, is
// killed, and loads again.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>

#include "tests/support/child_process.h"
#include "tests/support/folder_test.h"

namespace osteomill {
namespace {

using namespace std::chrono_literals;
using ::testing::AnyOf;
using testing::ChildProcess;
using testing::Finished;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

constexpr bool is_optimised = IS_OPTIMISED;

/// A NRRD of a block of bone in air, whose HU vary so that files of it do not shrink to nothing.
void write_block(const std::filesystem::path& path, int edge_voxels, double spacing_mm,
                 int bone_edge_voxels) {
    std::ofstream file(path, std::ios::binary);
    file << "NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: " << edge_voxels
         << ' ' << edge_voxels << ' ' << edge_voxels << "\nspace directions: (" << spacing_mm << ",0,0) (0,"
         << spacing_mm << ",0) (0,0," << spacing_mm
         << ")\nspace origin: (0,0,0)\nencoding: raw\nendian: little\n\n";
    std::mt19937 random(1);
    std::vector<std::int16_t> slice(static_cast<std::size_t>(edge_voxels) *
                                    static_cast<std::size_t>(edge_voxels));
    for (int z = 0; z < edge_voxels; ++z) {
        std::size_t i = 0;
        for (int y = 0; y < edge_voxels; ++y)
            for (int x = 0; x < edge_voxels; ++x, ++i)
                slice[i] = static_cast<std::int16_t>(
                    std::max({x, y, z}) < bone_edge_voxels ? 900 + static_cast<int>(random() % 800) : -1000);
        file.write(reinterpret_cast<const char*>(slice.data()),
                   static_cast<std::streamsize>(2 * slice.size()));
    }
}

/// Peak resident bytes of the largest child so far.
std::uint64_t peak_of_children() {
    rusage used{};
    ::getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
}

class SavedBone : public testing::FolderTest {
  protected:
    std::vector<std::string> server(const std::vector<std::string>& options) const {
        std::vector<std::string> command{HAPTIC_SERVER, "--clock", "virtual"};
        command.insert(command.end(), options.begin(), options.end());
        return command;
    }
    /// The checksum of a bone as the server loads it, or the message with which it refuses.
    std::string loaded(const std::string& bone) const {
        std::filesystem::remove(file("loaded.json"));
        const Finished run = testing::run_program(
            server({"--duration-s", "0.01", "--bone", bone, "--json", file("loaded.json")}));
        if (run.status == 0) return json("loaded.json").at("bone_checksum");
        EXPECT_EQ(run.status, 1) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_THAT(run.err, HasSubstr(std::filesystem::path(bone).stem().string()));
        return run.err;
    }
    /// Mills for a time and saves; returns the checksum of the bone left.
    std::string saved(const std::string& from, const std::string& to, const std::string& duration_s) const {
        const Finished run = testing::run_program(server(
            {"--duration-s", duration_s, "--bone", from, "--save-bone", to, "--json", file("saved.json")}));
        EXPECT_EQ(run.status, 0) << run.err;
        return json("saved.json").at("bone_checksum");
    }
};

TEST_F(SavedBone, KilledAtAnyMomentIsTheOldOrTheNewOne) {
    write_block(file("block.nrrd"), 160, 0.1, 150);
    const std::string old = saved(file("block.nrrd"), file("carved.nrrd"), "0.5");
    std::filesystem::create_directory(file("old"));
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        if (entry.path().filename().string().starts_with("carved"))
            std::filesystem::copy(entry.path(), folder_ / "old");
    const std::vector<std::string> save_again =
        server({"--duration-s", "2", "--bone", file("block.nrrd"), "--save-bone", file("carved.nrrd"),
                "--json", file("new.json")});
    ASSERT_EQ(testing::run_program(save_again).status, 0);
    const std::string fresh = json("new.json").at("bone_checksum");
    ASSERT_NE(fresh, old);
    ASSERT_EQ(loaded(file("carved.nrrd")), fresh);
    const std::uintmax_t whole_bytes = std::filesystem::file_size(file("carved.nrrd"));

    // The new files beside the old ones show how far the save has come.
    const auto written = [&] {
        std::uintmax_t bytes = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            std::error_code gone;
            const std::uintmax_t size = std::filesystem::file_size(entry.path(), gone);
            if (!gone && entry.path().filename().string().find(".part") != std::string::npos) bytes += size;
        }
        return bytes;
    };
    int kept = 0;
    constexpr unsigned kills = 6;
    for (unsigned round = 0; round < kills; ++round) {
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            if (entry.path().filename().string().starts_with("carved")) std::filesystem::remove(entry.path());
        std::filesystem::copy(folder_ / "old", folder_.path());
        ChildProcess killed(save_again);
        const std::uintmax_t at_bytes = 1 + whole_bytes * round / kills;
        const auto deadline = Clock::now() + testing::far_too_long;
        bool has_begun = false;
        while (Clock::now() < deadline) {
            const std::uintmax_t bytes = written();
            if (bytes >= at_bytes || (has_begun && bytes == 0)) break;
            has_begun = has_begun || bytes > 0;
        }
        killed.send_signal(SIGKILL);
        ASSERT_TRUE(killed.wait().has_value());
        const std::string now = loaded(file("carved.nrrd"));
        EXPECT_THAT(now, AnyOf(old, fresh)) << round;
        if (now == old) ++kept;
    }
    EXPECT_GT(kept, 0) << "some were killed before they were done";
}

TEST_F(SavedBone, OnAFullDiskTheOldOneStays) {
    write_block(file("block.nrrd"), 64, 0.1, 60);
    const std::string old = saved(file("block.nrrd"), file("carved.nrrd"), "0.5");
    const auto files_before = std::distance(std::filesystem::directory_iterator(folder_.path()), {});
    for (const char* blocks : {"0", "1", "40", "300"}) {
        const Finished run =
            testing::run_program({"/bin/bash", "-c",
                                  std::string("ulimit -f ") + blocks +
                                      "; exec " HAPTIC_SERVER " --clock virtual --duration-s 2 --bone '" +
                                      file("block.nrrd") + "' --save-bone '" + file("carved.nrrd") + "'"});
        EXPECT_EQ(run.status, 1) << blocks;
        EXPECT_THAT(run.err, HasSubstr("carved.nrrd: cannot be written: File too large"));
        EXPECT_EQ(loaded(file("carved.nrrd")), old) << blocks;
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), files_before + 2)
            << "the bone, loaded.json and its histograms";
    }
}

TEST_F(SavedBone, MayBeTheFileThatWasLoaded) {
    write_block(file("block.nrrd"), 64, 0.1, 60);
    const std::string first = saved(file("block.nrrd"), file("block.nrrd"), "1");
    EXPECT_EQ(loaded(file("block.nrrd")), first);
    const std::string second = saved(file("block.nrrd"), file("block.nrrd"), "2");
    EXPECT_NE(second, first);
    EXPECT_EQ(loaded(file("block.nrrd")), second);
}

// Refined to 451^3 voxels, of which few are bone.
TEST_F(SavedBone, TakesTheMemoryOfItsBoneNotOfItsGrid) {
    constexpr std::uint64_t volume_bytes = 2 * std::uint64_t{451} * 451 * 451;
    write_block(file("scan.nrrd"), 46, 1.0, 8);
    const Finished import = testing::run_program(
        {BONE_IMPORT, file("scan.nrrd"), file("bone.nrrd"), "--spacing-mm", "0.1", "--threshold-hu", "300"});
    ASSERT_EQ(import.status, 0) << import.err;
    for (int percent = 10; percent <= 100; percent += 10)
        EXPECT_THAT(import.err,
                    ::testing::ContainsRegex("refining " + std::to_string(percent) + " %(, [^\n]+ left)?\n"));
    const std::string checksum = saved(file("bone.nrrd"), file("carved.nrrd"), "0.1");
    EXPECT_EQ(loaded(file("carved.nrrd")), checksum);
    if (is_optimised) {
        EXPECT_LT(peak_of_children(), volume_bytes * 3 / 4) << "of both programs";
    }
}

}  // namespace
}  // namespace osteomill
