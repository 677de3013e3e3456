// The real program, as a user calls it: its files, its messages, its exit status.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/dense_bone_file.h"
#include "tests/support/raw_images.h"
#include "tests/support/synthetic_dicom.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using testing::DenseBoneFile;
using ::testing::HasSubstr;
using testing::read_bone_file;

struct Outcome {
    int exit_status = -1;
    std::vector<std::string> lines;  ///< from standard output and error together
    std::string last() const { return lines.empty() ? "" : lines.back(); }
};

class BoneImport : public ::testing::Test {
  protected:
    Outcome import(const std::filesystem::path& input, const std::string& options = "") {
        const std::string said = (folder_ / "said").string();
        const std::string command = std::string(BONE_IMPORT) + " '" + input.string() + "' '" +
                                    output_.string() + "' " + options + " > '" + said + "' 2>&1";
        const int status = std::system(command.c_str());
        Outcome outcome{.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 128, .lines = {}};
        std::ifstream file(said);
        for (std::string line; std::getline(file, line);) outcome.lines.push_back(line);
        return outcome;
    }
    /// Exit 1 and no output but one line that names the input.
    void expect_refused(const std::filesystem::path& input, const std::string& reason,
                        const std::string& options = "") {
        const Outcome outcome = import(input, options);
        EXPECT_EQ(outcome.exit_status, 1) << input << ": " << outcome.last();
        EXPECT_EQ(outcome.lines.size(), 1u) << input << ": " << outcome.last();
        EXPECT_THAT(outcome.last(), HasSubstr("bone_import: " + input.string()));
        EXPECT_THAT(outcome.last(), HasSubstr(reason));
        EXPECT_FALSE(std::filesystem::exists(output_)) << input;
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path output_ = folder_ / "bone.nrrd";
};

TEST_F(BoneImport, MakesABoneFileOfADicomSeries) {
    testing::write_series(folder_ / "series", testing::synthetic_series(5));
    const Outcome outcome = import(folder_ / "series", "--spacing-mm 0.5 --threshold-hu 250");
    ASSERT_EQ(outcome.exit_status, 0) << outcome.last();
    EXPECT_THAT(outcome.lines.front(), HasSubstr("GiB of memory")) << "the estimate comes first";
    EXPECT_THAT(outcome.lines, ::testing::Contains("refining 100 %"));
    EXPECT_EQ(outcome.last(), "bone: " + output_.string() + "; next: haptic_server --device client --bone '" +
                                  output_.string() + "'");
    const DenseBoneFile file = read_bone_file(output_);
    EXPECT_EQ(file.threshold_hu, 250.0);
    EXPECT_EQ(file.volume.grid,
              (Grid{.size_voxels = {23, 19, 17}, .spacing_mm = 0.5, .origin_mm = {-5.0, -4.0, 0.0}}));
    EXPECT_EQ(file.volume.hu.front(), -1000) << "far from bone";
    EXPECT_EQ(file.volume.hu.back(), 400);
}

TEST_F(BoneImport, SaysThatAThresholdLeavesNothingOrEverything) {
    testing::write_series(folder_ / "series", testing::synthetic_series(5));
    const Outcome nothing = import(folder_ / "series", "--threshold-hu 3000");
    EXPECT_EQ(nothing.exit_status, 1);
    EXPECT_THAT(nothing.last(), HasSubstr("no voxel reaches --threshold-hu 3000; the highest has "));
    EXPECT_THAT(nothing.lines, ::testing::Not(::testing::Contains(HasSubstr("refining")))) << "said early";
    const Outcome everything = import(folder_ / "series", "--spacing-mm 0.5 --threshold-hu -1024");
    EXPECT_EQ(everything.exit_status, 0);
    EXPECT_THAT(everything.lines, ::testing::Contains(HasSubstr("every voxel reaches --threshold-hu -1024")));
}

TEST_F(BoneImport, KeepsSoftTissueWhereToldTo) {
    testing::write_series(folder_ / "series", testing::synthetic_series(5));
    ASSERT_EQ(import(folder_ / "series", "--spacing-mm 0.5").exit_status, 0);
    const DenseBoneFile all = read_bone_file(output_);
    ASSERT_EQ(import(folder_ / "series", "--spacing-mm 0.5 --threshold-hu 250").exit_status, 0);
    const DenseBoneFile near_bone = read_bone_file(output_);
    ASSERT_EQ(
        import(folder_ / "series", "--spacing-mm 0.5 --threshold-hu 250 --keep-soft-tissue").exit_status, 0);
    const DenseBoneFile kept = read_bone_file(output_);
    EXPECT_EQ(kept.volume.hu, all.volume.hu);
    EXPECT_NE(near_bone.volume.hu, all.volume.hu);
    EXPECT_EQ(kept.threshold_hu, 250.0);
    const StiffnessRelation relation = default_stiffness_relation();
    EXPECT_EQ(checksum(bone_from_hu(kept.volume, 250.0, relation)),
              checksum(bone_from_hu(near_bone.volume, 250.0, relation)))
        << "the bone is the same";
}

TEST_F(BoneImport, PreviewsEveryVoxelAsAByteOfGrey) {
    testing::write_series(folder_ / "series", testing::synthetic_series(5));
    ASSERT_EQ(import(folder_ / "series", "--spacing-mm 0.5").exit_status, 0);
    const std::vector<std::int16_t> hu = read_bone_file(output_).volume.hu;
    const std::string raw = (folder_ / "new/look.raw").string();
    const std::string command = std::string(BONE_IMPORT) + " '" + (folder_ / "series").string() +
                                "' --preview '" + raw + "' > /dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string greys = [&] {
        std::ifstream in(raw, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    }();
    ASSERT_EQ(greys.size(), hu.size());
    for (std::size_t i = 0; i < hu.size(); ++i) {  // -200 HU is black, 1800 white
        const double grey = 255.0 * std::clamp((hu[i] + 200.0) / 2000.0, 0.0, 1.0);
        ASSERT_NEAR(static_cast<std::uint8_t>(greys[i]), grey, 0.5) << "voxel " << i;
    }
}

TEST_F(BoneImport, ClipsARegionAndSaysSo) {
    testing::write_series(folder_ / "series", testing::synthetic_series(5));
    const Outcome outcome = import(folder_ / "series", "--spacing-mm 0.5 --region -3,-2,1,50,0,4");
    ASSERT_EQ(outcome.exit_status, 0) << outcome.last();
    EXPECT_THAT(outcome.lines.front(), HasSubstr("clipped to -3.0,-2.0,1.0,6.0,0.0,4.0"));
    EXPECT_EQ(read_bone_file(output_).volume.grid.origin_mm, glm::dvec3(-3.0, -2.0, 1.0));
}

/// A dome whose slices are 2 mm apart and whose pixels 0.5.
std::string dome() {
    std::string file = testing::with(testing::nrrd_header(), "sizes: 3 4 5", "sizes: 121 121 13");
    file = testing::with(file, "(1,0,0) (0,1,0)", "(0.5,0,0) (0,0.5,0)");
    file = testing::with(file, "(1,2,3)", "(-30,-30,0)");
    for (int z = 0; z < 13; ++z)
        for (int y = 0; y < 121; ++y)
            for (int x = 0; x < 121; ++x) {
                const double depth_mm = 40.0 - std::hypot(0.5 * x - 30.0, 0.5 * y - 30.0, 2.0 * z + 20.0);
                const auto hu = static_cast<std::int16_t>(std::clamp(600.0 + 2000.0 * depth_mm, 0.0, 1200.0));
                file.append(reinterpret_cast<const char*>(&hu), sizeof hu);
            }
    return file;
}

TEST_F(BoneImport, OfSlicesFarApartHasNoStairs) {
    testing::write_bytes(folder_ / "dome.nrrd", dome());
    const std::string options = "--spacing-mm 0.5 --threshold-hu 600 --keep-soft-tissue";
    ASSERT_EQ(import(folder_ / "dome.nrrd", options).exit_status, 0);
    const HuVolume bone = read_bone_file(output_).volume;
    const auto hu = [&](const glm::ivec3& voxel) {
        const glm::ivec3 size = bone.grid.size_voxels;
        return bone.hu[static_cast<std::size_t>(voxel.x + size.x * (voxel.y + size.y * voxel.z))];
    };
    // The places at which the surface leans by 25 to 45 degrees, halfway between slices.
    for (const int z : {14, 18, 22, 26})
        for (int x = 61; x < 120; ++x) {
            const double before = hu({x, 60, z}) - 600.0;
            const double after = hu({x + 1, 60, z}) - 600.0;
            if (before < 0.0 || after >= 0.0) continue;
            const double at_mm = 0.5 * (x + before / (before - after)) - 30.0;
            EXPECT_NEAR(std::hypot(at_mm, 0.5 * z + 20.0), 40.0, 0.1) << z;
        }
}

TEST_F(BoneImport, OfARegionOfSlicesFarApartIsThatPartOfTheWhole) {
    testing::write_bytes(folder_ / "dome.nrrd", dome());
    const std::string options = "--spacing-mm 0.5 --threshold-hu 600 --keep-soft-tissue";
    ASSERT_EQ(import(folder_ / "dome.nrrd", options).exit_status, 0);
    const HuVolume whole = read_bone_file(output_).volume;
    ASSERT_EQ(import(folder_ / "dome.nrrd", options + " --region 10,-5,6,20,5,14").exit_status, 0);
    const HuVolume part = read_bone_file(output_).volume;
    const glm::ivec3 size = whole.grid.size_voxels;
    std::size_t i = 0;
    for (int z = 0; z < part.grid.size_voxels.z; ++z)
        for (int y = 0; y < part.grid.size_voxels.y; ++y)
            for (int x = 0; x < part.grid.size_voxels.x; ++x, ++i)
                ASSERT_NEAR(
                    part.hu[i],
                    whole.hu[static_cast<std::size_t>(x + 80 + size.x * (y + 50 + size.y * (z + 12)))], 1)
                    << x << ' ' << y << ' ' << z;
}

TEST_F(BoneImport, RefusesInOneLine) {
    testing::write_series(folder_ / "series", testing::synthetic_series(5));
    expect_refused(folder_ / "nowhere", "does not exist");
    expect_refused(folder_ / "series", "which covers -5.0,-4.0,0.0,6.0,5.0,8.0", "--region 20,0,0,30,5,5");
    std::filesystem::remove(folder_ / "series/02.dcm");
    expect_refused(folder_ / "series", "1 missing slice");
}

TEST_F(BoneImport, RefusesAnImportOfMoreVoxelsThanABoneMayHave) {
    std::vector<testing::SyntheticSlice> slices = testing::synthetic_series(3);
    for (std::size_t i = 0; i < slices.size(); ++i) {
        slices[i].pixel_spacing_mm = {50.0, 50.0};
        slices[i].position_mm.z = 100.0 * static_cast<double>(i);
    }
    testing::write_series(folder_ / "series", slices);
    const Outcome outcome = import(folder_ / "series", "--spacing-mm 0.02");
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_THAT(outcome.last(), HasSubstr("--spacing-mm"));
}

TEST_F(BoneImport, ExitsWithTwoOnWrongUsage) {
    for (const char* options : {"--region 1,2,3", "--spacing-mm 0", "--spacing-mm nan", "--threshold-hu nan",
                                "--rescale 1", "--intensity-window 5,1",
                                "--rescale 1,2 --intensity-window 1,2", "--keep-soft-tissue", "--nonsense"}) {
        const Outcome outcome = import(folder_.path(), options);
        EXPECT_EQ(outcome.exit_status, 2) << options;
        EXPECT_EQ(outcome.lines.size(), 1u) << options;
    }
}

class BoneImportOfRealScans : public BoneImport {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("OSTEOMILL_SCANS");
        if (folder == nullptr) GTEST_SKIP() << "OSTEOMILL_SCANS does not name the folder of trial scans";
        scans_ = folder;
    }
    std::filesystem::path scans_;
};

TEST_F(BoneImportOfRealScans, RefusesATiltedGantry) {
    expect_refused(scans_ / "gantry_tilt_ct", "gantry tilt of 18.5");
}

TEST_F(BoneImportOfRealScans, RefinesARegionOfTheHead) {
    const Outcome whole = import(scans_ / "head_ct", "--spacing-mm 0.4 --region -60,10,730,-20,50,770");
    ASSERT_EQ(whole.exit_status, 0) << whole.last();
    const std::vector<std::int16_t> hu = read_bone_file(output_).volume.hu;
    EXPECT_GT(*std::max_element(hu.begin(), hu.end()), 700);
    EXPECT_LT(*std::min_element(hu.begin(), hu.end()), -900);
}

TEST_F(BoneImportOfRealScans, ImportsOrRefusesEveryBadDicomSeries) {
    int refused = 0;
    int imported = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scans_ / "bad_dicom")) {
        const bool of_files =
            entry.is_directory() && entry.path().string().find("cornerstone") == std::string::npos &&
            std::any_of(std::filesystem::directory_iterator(entry.path()), {},
                        [](const auto& inner) { return inner.path().extension() == ".dcm"; });
        const bool single = entry.is_regular_file() && entry.path().parent_path().filename() == "cornerstone";
        if (!of_files && !single) continue;
        std::filesystem::remove(output_);
        const Outcome outcome = import(entry.path(), "--spacing-mm 2");
        if (outcome.exit_status == 0) {
            ++imported;
            EXPECT_FALSE(read_bone_file(output_).volume.hu.empty()) << entry.path();
        } else {
            ++refused;
            EXPECT_EQ(outcome.exit_status, 1) << entry.path();
            EXPECT_EQ(outcome.lines.size(), 1u) << entry.path();
            EXPECT_THAT(outcome.last(), HasSubstr(entry.path().string()));
        }
    }
    EXPECT_GE(refused, 20);
    EXPECT_GE(imported, 7) << "the compressed, the multi-frame and the anisotropic series are sound";
}

}  // namespace
}  // namespace osteomill
