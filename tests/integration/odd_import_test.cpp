// Odd files that are sound, or can be mended, and the real bone_import: its results and its messages. And
// hostile files for the server.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>

#include "tests/support/child_process.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/raw_dicom.h"
#include "tests/support/raw_images.h"
#include "tests/support/synthetic_dicom.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::odd_import_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

std::string ramp(std::size_t voxels) {
    std::string bytes;
    for (std::size_t i = 0; i < voxels; ++i) bytes += little(static_cast<std::uint32_t>(i), 2);
    return bytes;
}

class OddImport : public ::testing::Test {
  protected:
    /// The HU of an import at the file's own spacing of 1 mm, which changes none of them.
    std::vector<std::int16_t> import(const std::filesystem::path& input) {
        said_ =
            run_program({BONE_IMPORT, input.string(), (folder_ / "bone.nrrd").string(), "--spacing-mm", "1"});
        EXPECT_EQ(said_.status, 0) << said_.err;
        if (said_.status != 0) return {};
        return testing::read_bone_file(folder_ / "bone.nrrd").volume.hu;
    }
    void expect_ramp(const std::vector<std::int16_t>& hu) {
        ASSERT_EQ(hu.size(), 60u);
        for (int i = 0; i < 60; ++i) EXPECT_NEAR(hu[static_cast<std::size_t>(i)], i, 1) << i;
    }
    TemporaryFolder folder_;
    Finished said_;
};

TEST_F(OddImport, ReadsAMetaImageOfOneFileForEachSlice) {
    const std::string all = ramp(60);
    std::string list = "LIST";
    for (int i = 0; i < 5; ++i) {
        const std::string number = std::to_string(10 + 2 * i);
        write_bytes(folder_ / ("s" + number + ".raw"), all.substr(24u * static_cast<unsigned>(i), 24));
        list += "\ns" + number + ".raw";
    }
    const auto one_mm = [](const std::string& header) { return with(header, "1 1 2", "1 1 1"); };
    write_bytes(folder_ / "pattern.mhd", one_mm(meta_header("s%d.raw 10 18 2")));
    expect_ramp(import(folder_ / "pattern.mhd"));
    write_bytes(folder_ / "list.mhd", one_mm(meta_header(list)));
    expect_ramp(import(folder_ / "list.mhd"));
    write_bytes(folder_ / "pattern.nhdr",
                with(nrrd_header("data file: s%d.raw 10 18 2\n"), "(0,0,2)", "(0,0,1)"));
    expect_ramp(import(folder_ / "pattern.nhdr"));
}

TEST_F(OddImport, ReadsWhatIsCompressedAndWhatIsBigEndian) {
    const std::string all = ramp(60);
    write_bytes(folder_ / "zlib.mha",
                with(meta_header("LOCAL", "CompressedData = True\n"), "1 1 2", "1 1 1") + deflated(all, 15));
    expect_ramp(import(folder_ / "zlib.mha"));
    std::string big = all;
    for (std::size_t i = 0; i < big.size(); i += 2) std::swap(big[i], big[i + 1]);
    write_bytes(folder_ / "big.mha",
                with(with(meta_header(), "MSB = False", "MSB = True"), "1 1 2", "1 1 1") + big);
    expect_ramp(import(folder_ / "big.mha"));
    const std::string two_members = deflated(all.substr(0, 50)) + deflated(all.substr(50));
    write_bytes(folder_ / "members.nrrd",
                with(with(nrrd_header(), "raw", "gzip"), "(0,0,2)", "(0,0,1)") + two_members);
    expect_ramp(import(folder_ / "members.nrrd"));
}

TEST_F(OddImport, ReadsEveryEncodingAndTypeOfANrrd) {
    const auto one_mm = [](const std::string& header) { return with(header, "(0,0,2)", "(0,0,1)"); };
    std::string text;
    std::string wide;
    for (int i = 0; i < 60; ++i) {
        text += std::to_string(i) + (i % 7 == 6 ? "\n" : " ");
        wide += little(static_cast<std::uint32_t>(i), 4) + std::string(4, '\0');
    }
    const std::string raw = one_mm(nrrd_header());
    write_bytes(folder_ / "text.nrrd", with(raw, "raw", "ascii") + text);
    expect_ramp(import(folder_ / "text.nrrd"));
    write_bytes(folder_ / "wide.nrrd", with(raw, "int16", "int64") + wide);
    expect_ramp(import(folder_ / "wide.nrrd"));
    write_bytes(folder_ / "wide_gzip.nrrd",
                with(with(raw, "int16", "uint64"), "raw", "gzip") + deflated(wide));
    expect_ramp(import(folder_ / "wide_gzip.nrrd"));
}

TEST_F(OddImport, SaysOfLabelsWhatItHadToAssume) {
    write_bytes(folder_ / "scan.nrrd", with(nrrd_header(), "(0,0,2)", "(0,0,1)") + ramp(60));
    std::string labels(60, '\0');
    labels[22] = 1;
    write_bytes(folder_ / "nerve.mha",
                with(with(meta_header(), "MET_SHORT", "MET_UCHAR"), "1 1 2", "1 1 1") + labels);
    said_ = run_program({BONE_IMPORT, (folder_ / "scan.nrrd").string(), "--segmentation",
                         (folder_ / "nerve.mha").string(), "--case", (folder_ / "case").string(),
                         "--threshold-hu", "20", "--spacing-mm", "1"});
    EXPECT_EQ(said_.status, 0);
    EXPECT_THAT(
        said_.err,
        HasSubstr("nerve.mha: warning: its header has no TransformMatrix; left and right are a guess"));
}

TEST_F(OddImport, RefusesTextThatIsNoNumbers) {
    const std::string header = with(nrrd_header(), "raw", "ascii");
    const auto refusal = [&](const std::string& text) {
        write_bytes(folder_ / "x.nrrd", header + text);
        said_ = run_program({BONE_IMPORT, (folder_ / "x.nrrd").string(), (folder_ / "bone.nrrd").string()});
        EXPECT_EQ(said_.status, 1);
        return said_.err;
    };
    std::string ones;
    for (int i = 0; i < 59; ++i) ones += "10 ";
    EXPECT_THAT(refusal(ones), HasSubstr("fewer numbers than voxels"));
    EXPECT_THAT(refusal(ones + "1x"), HasSubstr("'1x' is no number"));
    EXPECT_THAT(refusal(ones + std::string(1000, '1')), HasSubstr("is no number"));
}

TEST_F(OddImport, MakesNoBoneOfTheEdgeOfAFieldOfView) {
    // Soft tissue of 40 HU, cut by a round field, with a post of bone in its middle.
    std::string voxels;
    for (int i = 0; i < 8 * 32 * 32; ++i) {
        const double r = std::hypot(i % 32 - 15.5, i / 32 % 32 - 15.5);
        const int hu = r > 14.0 ? -3024 : r < 4.0 ? 1500 : 40;
        voxels += little(static_cast<std::uint32_t>(hu), 2);
    }
    write_bytes(folder_ / "padded.nrrd",
                with(with(nrrd_header(), "3 4 5", "32 32 8"), "(0,0,2)", "(0,0,1)") + voxels);
    said_ = run_program({BONE_IMPORT, (folder_ / "padded.nrrd").string(), (folder_ / "bone.nrrd").string(),
                         "--spacing-mm", "0.25", "--threshold-hu", "300"});
    ASSERT_EQ(said_.status, 0) << said_.err;
    EXPECT_THAT(said_.err, HasSubstr("-3024 HU fill what lies outside its field of view"));
    const HuVolume volume = testing::read_bone_file(folder_ / "bone.nrrd").volume;
    const glm::ivec3 size = volume.grid.size_voxels;
    int outside_the_post = 0;
    for (int i = 0; i < size.x * size.y * size.z; ++i) {
        const double r = std::hypot(0.25 * (i % size.x) - 15.5, 0.25 * (i / size.x % size.y) - 15.5);
        outside_the_post += r > 6.0 && volume.hu[static_cast<std::size_t>(i)] >= 300 ? 1 : 0;
    }
    EXPECT_EQ(outside_the_post, 0);
}

TEST_F(OddImport, SaysThatBytesFollowTheVoxels) {
    write_bytes(folder_ / "more.mha", meta_header() + std::string(raw_image_bytes + 3, '\0'));
    import(folder_ / "more.mha");
    EXPECT_THAT(said_.err, HasSubstr("3 bytes follow its voxels; they are not read"));
}

TEST_F(OddImport, TakesTheScanBesideItsSegmentation) {
    write_series(folder_ / "series", synthetic_series(3));
    RawSlice segmentation;
    segmentation.sop_class = "1.2.840.10008.5.1.4.1.1.66.4";
    segmentation.modality = "SEG";
    for (int i = 0; i < 9; ++i)
        write_bytes(folder_ / "series" / ("seg" + std::to_string(i)), raw_dicom(segmentation));
    EXPECT_FALSE(import(folder_ / "series").empty());
}

TEST_F(OddImport, WarnsOfAModalityThatIsNotCt) {
    RawSlice slice;
    slice.modality = "MR";
    for (const char* z : {"0", "1", "2"}) {
        slice.position = std::string("0\\0\\") + z;
        write_bytes(folder_ / "series" / z, raw_dicom(slice));
    }
    import(folder_ / "series");
    EXPECT_THAT(said_.err, HasSubstr("its modality is MR, not CT"));
}

/// The messages and remaining files of an import of minutes that is stopped as soon as it works.
TEST(StoppedImport, LeavesNothingAndSaysSo) {
    const TemporaryFolder folder;
    write_series(folder / "series", synthetic_series(5));
    write_bytes(folder / "bone.part-0123abcd.nrrd", "of one that was killed");
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{(folder / "bone.nrrd").string()},
          std::vector<std::string>{"--case", (folder / "case").string()}}) {
        std::vector<std::string> command{BONE_IMPORT, (folder / "series").string(), "--spacing-mm", "0.012"};
        command.insert(command.end(), options.begin(), options.end());
        ChildProcess import(command);
        for (int i = 0; i < 3000 && import.err().find("refining") == std::string::npos; ++i)
            import.read_output();
        import.send_signal(SIGINT);
        EXPECT_EQ(import.wait(std::chrono::seconds(100)), 1) << import.err();
        EXPECT_THAT(import.err(), ::testing::EndsWith("bone_import: stopped; nothing was written\n"));
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
            << "the series, and not the part of another time";
    }
}

TEST_F(OddImport, FollowsTheSignOfAJpeg2000Codestream) {
    std::vector<SyntheticSlice> slices = synthetic_series(3);
    for (SyntheticSlice& slice : slices) {
        slice.intercept = 0.0;
        for (std::size_t i = 0; i < slice.stored.size(); ++i)
            slice.stored[i] = static_cast<std::int16_t>(static_cast<int>(i) * 20 - 1000);
    }
    write_series(folder_ / "right", slices);
    std::filesystem::create_directory(folder_ / "wrong");
    for (const char* name : {"00.dcm", "01.dcm", "02.dcm"}) {
        compress_as_jpeg2000(folder_ / "right" / name, folder_ / "right" / name);
        std::ifstream in(folder_ / "right" / name, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        write_bytes(folder_ / "wrong" / name,
                    with(bytes, dicom_number(0x0028, 0x0103, 1), dicom_number(0x0028, 0x0103, 0)));
    }
    const std::vector<std::int16_t> right = import(folder_ / "right");
    EXPECT_THAT(said_.err, Not(HasSubstr("codestream")));
    EXPECT_EQ(right.at(0), -1000);
    EXPECT_EQ(import(folder_ / "wrong"), right);
    EXPECT_THAT(said_.err,
                HasSubstr("warning: 3 file(s) say unsigned pixels (0028,0103) where their JPEG 2000 "
                          "codestream says signed; the codestream is followed"));
}

TEST_F(OddImport, ReadsTheFramesOfAFileInTheOrderInWhichTheyLie) {
    constexpr std::size_t pixels = 120;
    const auto stored = [](std::size_t frame, std::size_t i) {
        return static_cast<std::uint32_t>(400 + 200 * frame + i);
    };
    RawSlice file = multi_frame({2, 0, 1});
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        file.pixels.replace(2 * i, 2, little(stored(i / pixels, i % pixels), 2));
    write_bytes(folder_ / "frames.dcm", raw_dicom(file));
    const std::vector<std::int16_t> hu = import(folder_ / "frames.dcm");
    ASSERT_EQ(hu.size(), 3 * pixels);
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < pixels; ++i)
            EXPECT_EQ(hu[pixels * k + i], 2 * static_cast<int>(stored((k + 1) % 3, i)) - 1000);
    compress_as_jpeg2000(folder_ / "frames.dcm", folder_ / "compressed.dcm");
    EXPECT_EQ(import(folder_ / "compressed.dcm"), hu);
}

TEST_F(OddImport, RefusesFramesThatAreCutOff) {
    std::string bytes = raw_dicom(multi_frame({0, 1, 2}));
    bytes.resize(bytes.size() - 2);
    write_bytes(folder_ / "cut.dcm", bytes);
    const Finished said =
        run_program({BONE_IMPORT, (folder_ / "cut.dcm").string(), (folder_ / "bone.nrrd").string()});
    EXPECT_EQ(said.status, 1);
    EXPECT_THAT(said.err, HasSubstr("cut off"));
}

TEST_F(OddImport, RefusesAFileThatMayNotBeRead) {
    if (::geteuid() == 0) GTEST_SKIP() << "root reads everything";
    write_series(folder_ / "series", synthetic_series(3));
    std::filesystem::permissions(folder_ / "series/02.dcm", std::filesystem::perms::none);
    const Finished said =
        run_program({BONE_IMPORT, (folder_ / "series").string(), (folder_ / "bone.nrrd").string()});
    EXPECT_EQ(said.status, 1);
    EXPECT_THAT(said.err, HasSubstr("02.dcm: cannot be opened"));
}

class HostileServer : public ::testing::Test {
  protected:
    void expect_refused(const std::vector<std::string>& options, const std::string& reason) {
        std::vector<std::string> command{HAPTIC_SERVER, "--duration-s", "0.1"};
        command.insert(command.end(), options.begin(), options.end());
        const Finished said = run_program(command, std::chrono::seconds(60));
        EXPECT_EQ(said.status, 1) << said.err;
        EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
        EXPECT_THAT(said.err, HasSubstr(reason));
    }
    TemporaryFolder folder_;
};

TEST_F(HostileServer, RefusesAKeyOfManyDots) {
    std::string key = "a";
    for (int i = 0; i < 100'000; ++i) key += ".a";
    write_bytes(folder_ / "x.toml", key + " = 1\n");
    expect_refused({"--scene", (folder_ / "x.toml").string()}, "x.toml:1: a key of more than 32 parts");
    expect_refused({"--device", "hid", "--device-profile", (folder_ / "x.toml").string()},
                   "x.toml:1: a key of more than 32 parts");
}

TEST_F(HostileServer, RefusesPipesAndDevices) {
    ASSERT_EQ(::mkfifo((folder_ / "x.toml").c_str(), 0600), 0);
    expect_refused({"--scene", (folder_ / "x.toml").string()}, "cannot be read");
    expect_refused({"--scene", "/dev/zero"}, "cannot be read");
    ASSERT_EQ(::mkfifo((folder_ / "x.nrrd").c_str(), 0600), 0);
    expect_refused({"--bone", (folder_ / "x.nrrd").string()}, "is not a file");
}

TEST_F(HostileServer, RefusesABoneWhoseGzipChecksumIsWrong) {
    std::string bytes = with(with(nrrd_header(), "raw", "gzip"), "(0,0,2)", "(0,0,1)") +
                        deflated(std::string(raw_image_bytes, '\1'));
    bytes[bytes.size() - 6] = static_cast<char>(bytes[bytes.size() - 6] ^ 1);
    write_bytes(folder_ / "x.nrrd", bytes);
    expect_refused({"--bone", (folder_ / "x.nrrd").string()}, "its compressed voxels are damaged");
}

}  // namespace
}  // namespace osteomill::odd_import_test
