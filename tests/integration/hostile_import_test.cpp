// Hostile files and the real bone_import: each is refused in one line on standard error with exit status 1,
// in bounded memory and time, and nothing is written.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <ostream>

#include "tests/support/child_process.h"
#include "tests/support/messages.h"
#include "tests/support/raw_dicom.h"
#include "tests/support/raw_images.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::hostile_import_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

const std::string voxels(raw_image_bytes, '\0');
const std::string slice(raw_image_bytes / 5, '\0');

/// Addresses that the program may use, in KiB: its libraries take 0.5 GiB. Sanitizers take them all.
constexpr int most_kib = 2 * 1024 * 1024;
constexpr std::chrono::seconds deadline(60);

Finished import(const std::filesystem::path& input, const std::filesystem::path& output) {
    const std::string limit = BOUNDS_MEMORY ? "ulimit -v " + std::to_string(most_kib) + "; " : "";
    return run_program({"/bin/bash", "-c", limit + "exec \"$@\"", "bash", BONE_IMPORT, input.string(),
                        output.string(), "--spacing-mm", "0.5"},
                       deadline);
}

struct Attack {
    const char* name;
    /// Writes the files of the attack into the folder; returns the input to import.
    std::function<std::filesystem::path(const std::filesystem::path& folder)> write;
    const char* reason;  ///< a text that the refusal must contain

    friend std::ostream& operator<<(std::ostream& out, const Attack& attack) { return out << attack.name; }
};

/// One file of this name.
auto file(const std::string& name, const std::string& bytes) {
    return [=](const std::filesystem::path& folder) {
        write_bytes(folder / name, bytes);
        return folder / name;
    };
}

/// The same, of bytes that take long to make: every test of this program begins with the lists of all
/// attacks.
auto large_file(const std::string& name, const std::function<std::string()>& make) {
    return [=](const std::filesystem::path& folder) { return file(name, make())(folder); };
}

/// A header and the files beside it; imports the header.
auto files(const std::string& name, const std::string& bytes,
           const std::vector<std::pair<std::string, std::string>>& others) {
    return [=](const std::filesystem::path& folder) {
        for (const auto& [other, content] : others) write_bytes(folder / other, content);
        write_bytes(folder / name, bytes);
        return folder / name;
    };
}

/// A pipe beside the header.
auto with_pipe(const std::string& name, const std::string& bytes, const std::string& pipe) {
    return [=](const std::filesystem::path& folder) {
        write_bytes(folder / name, bytes);
        if (::mkfifo((folder / pipe).c_str(), 0600) != 0) throw std::runtime_error("no pipe");
        return folder / name;
    };
}

std::vector<std::pair<std::string, std::string>> five_slices() {
    std::vector<std::pair<std::string, std::string>> slices;
    for (const char* number : {"1", "2", "3", "4", "5"})
        slices.emplace_back(std::string("s00") + number + ".raw", slice);
    return slices;
}

std::vector<std::pair<std::string, std::string>> four_slices() {
    auto slices = five_slices();
    slices.erase(slices.begin() + 2);
    return slices;
}

std::vector<std::pair<std::string, std::string>> one_short_slice() {
    auto slices = five_slices();
    slices[3].second.resize(10);
    return slices;
}

/// Three raw DICOM slices in a folder.
auto series(const RawSlice& spoiled) {
    return [=](const std::filesystem::path& folder) {
        for (int i = 0; i < 3; ++i) {
            RawSlice one = spoiled;
            one.position += std::to_string(i);
            write_bytes(folder / "series" / (std::to_string(i) + ".dcm"), raw_dicom(one));
        }
        return folder / "series";
    };
}

RawSlice spoiled(const std::function<void(RawSlice&)>& spoil) {
    RawSlice one;
    one.position = "0\\0\\";
    spoil(one);
    return one;
}

std::string spoiled_nifti(std::size_t offset, auto value) {
    std::string bytes = nifti();
    put(bytes, offset, value);
    return bytes;
}

std::string flipped(std::string bytes, std::size_t from_end) {
    bytes[bytes.size() - from_end] = static_cast<char>(bytes[bytes.size() - from_end] ^ 0x10);
    return bytes;
}

std::string shorter(std::string bytes, std::size_t by) {
    bytes.resize(bytes.size() - by);
    return bytes;
}

const std::string list = "LIST\ns001.raw\ns002.raw\ns003.raw\ns004.raw\ns005.raw";
const std::string gzip_nrrd = with(nrrd_header(), "encoding: raw", "encoding: gzip");
const std::string zlib_mha = meta_header("LOCAL", "CompressedData = True\n");
const float not_a_number = std::numeric_limits<float>::quiet_NaN();

const std::vector<Attack> attacks{
    // Files of voxels beside a header.
    {"mhd_missing_slice", files("x.mhd", meta_header("s%03d.raw 1 5 1"), four_slices()), "s003.raw"},
    {"mhd_short_slice", files("x.mhd", meta_header("s%03d.raw 1 5 1"), one_short_slice()), "s004.raw: is cut off"},
    {"mhd_too_few_numbers", files("x.mhd", meta_header("s%03d.raw 1 4 1"), five_slices()), "names 4 files"},
    {"mhd_missing_in_list", files("x.mhd", meta_header(list), four_slices()), "s003.raw"},
    {"mhd_short_in_list", files("x.mhd", meta_header(list), one_short_slice()), "s004.raw: is cut off"},
    {"mhd_short_list", files("x.mhd", meta_header("LIST\ns001.raw\ns002.raw"), five_slices()), "names 2 files"},
    {"mhd_format_string", file("x.mhd", meta_header("s%s.raw 1 5 1")), "no other %"},
    {"mhd_writing_format_string", file("x.mhd", meta_header("s%n.raw 1 5 1")), "no other %"},
    {"mhd_two_conversions", file("x.mhd", meta_header("s%d%s.raw 1 5 1")), "no other %"},
    {"mhd_wide_conversion", file("x.mhd", meta_header("s%0999999999d.raw 1 5 1")), "no other %"},
    {"mhd_absolute_file", file("x.mhd", meta_header("/etc/passwd")), "leads out of the header's folder"},
    {"mhd_file_above", files("sub/x.mhd", meta_header("../y.raw"), {{"y.raw", voxels}}), "leads out of the header's folder"},
    {"mhd_link_out",
     [](const std::filesystem::path& folder) {
         write_bytes(folder / "y.raw", voxels);
         write_bytes(folder / "sub/x.mhd", meta_header("y.raw"));
         std::filesystem::create_symlink("../y.raw", folder / "sub/y.raw");
         return folder / "sub/x.mhd";
     },
     "leads out of the header's folder"},
    {"mhd_pipe", with_pipe("x.mhd", meta_header("y.raw"), "y.raw"), "is not a file"},
    {"mhd_device",
     [](const std::filesystem::path& folder) {
         write_bytes(folder / "x.mhd", meta_header("y.raw"));
         std::filesystem::create_symlink("/dev/zero", folder / "y.raw");
         return folder / "x.mhd";
     },
     "is not a file"},
    {"nhdr_pipe", with_pipe("x.nhdr", nrrd_header("data file: y.raw\n"), "y.raw"), "is not a file"},
    {"nhdr_format_string", file("x.nhdr", nrrd_header("data file: s%s%d.raw 1 5 1\n")), "no other %"},
    {"nhdr_missing_slice", files("x.nhdr", nrrd_header("data file: s%03d.raw 1 5 1\n"), four_slices()), "s003.raw"},
    {"nhdr_short_slice", files("x.nhdr", nrrd_header("data file: s%03d.raw 1 5 1\n"), one_short_slice()), "s004.raw"},
    {"nhdr_absolute_file", file("x.nhdr", nrrd_header("data file: /etc/passwd\n")), "leads out of"},
    {"img_pipe", with_pipe("x.hdr", with(nifti().substr(0, 352), "n+1", "ni1"), "x.img"), "is not a file"},
    {"input_pipe",
     [](const std::filesystem::path& folder) {
         if (::mkfifo((folder / "x.nrrd").c_str(), 0600) != 0) throw std::runtime_error("no pipe");
         return folder / "x.nrrd";
     },
     "neither a file nor a folder"},
    {"input_device", [](const std::filesystem::path&) { return std::filesystem::path("/dev/zero"); },
     "neither a file nor a folder"},

    // Statements that a header may not make.
    {"mhd_negative_dimensions", file("x.mha", with(meta_header(), "NDims = 3", "NDims = -1") + voxels), "-1 dimensions"},
    {"mhd_many_dimensions", file("x.mha", with(meta_header(), "NDims = 3", "NDims = 2000000000") + voxels), "dimensions"},
    {"mhd_negative_size", file("x.mha", with(meta_header(), "3 4 5", "3 4 -5") + voxels), "DimSize"},
    {"mhd_huge_size", file("x.mha", with(meta_header(), "3 4 5", "65000 65000 65000") + voxels), "more than"},
    {"mhd_far_origin", file("x.mha", with(meta_header(), "1 2 3", "1e308 0 0") + voxels), "Offset"},
    {"mhd_tiny_spacing", file("x.mha", with(meta_header(), "1 1 2", "1e-9 1 1") + voxels), "ElementSpacing 1e-09 mm"},
    {"mhd_long_field", file("x.mha", std::string(100'000, 'a') + " = 1\n" + with(meta_header(), "3 4 5", "1 1 1")), "is cut off: 0 of 2 bytes"},
    {"mhd_long_value", file("x.mha", with(meta_header(std::string(100'000, 'b')), "ObjectType", "Comment = " + std::string(100'000, 'c') + "\nObjectType")), "which is not there"},
    {"mhd_without_end", file("x.mha", std::string(3u << 20, 'a')), "no end"},
    {"nrrd_far_origin", file("x.nrrd", with(nrrd_header(), "(1,2,3)", "(1e308,0,0)") + voxels), "space origin"},
    {"nrrd_tiny_spacing", file("x.nrrd", with(nrrd_header(), "(1,0,0)", "(1e-9,0,0)") + voxels), "1e-09 mm"},
    {"nrrd_huge_size", file("x.nrrd", with(nrrd_header(), "sizes: 3 4 5", "sizes: 60000 60000 60000") + voxels), "more than"},
    {"nrrd_overflowing_size", file("x.nrrd", with(nrrd_header(), "sizes: 3 4 5", "sizes: 18446744073709551615 2 2") + voxels), "an axis of"},
    {"nrrd_many_dimensions", file("x.nrrd", with(nrrd_header(), "dimension: 3", "dimension: 4000000000") + voxels), "dimension"},
    {"nrrd_without_end", file("x.nrrd", "NRRD0005\n" + std::string(3u << 20, 'a')), "header without end"},
    {"nrrd_field_twice", file("x.nrrd", nrrd_header("sizes: 30 40 50\n") + voxels), "twice"},
    {"nrrd_lines_to_skip", file("x.nrrd", nrrd_header("line skip: 4000000000\n") + voxels), "lead nowhere"},
    {"nrrd_bytes_to_skip", file("x.nrrd", nrrd_header("byte skip: -7\n") + voxels), "lead nowhere"},
    {"nifti_sform_of_nan", file("x.nii", spoiled_nifti(280, not_a_number)), "sform"},
    {"nifti_sform_of_zeros", file("x.nii", spoiled_nifti(280, std::array<float, 12>{})), "sform"},
    {"nifti_qform_of_nan", file("x.nii", [] {
         std::string bytes = spoiled_nifti(256, not_a_number);
         put(bytes, 252, std::int16_t{1});
         return bytes;
     }()), "qform"},
    {"nifti_negative_offset", file("x.nii", spoiled_nifti(108, -352.0F)), "vox_offset"},
    {"nifti_offset_in_header", file("x.nii", spoiled_nifti(108, 10.0F)), "vox_offset"},
    {"nifti_offset_of_nan", file("x.nii", spoiled_nifti(108, not_a_number)), "vox_offset"},
    {"nifti_huge_offset", file("x.nii", spoiled_nifti(108, 1e30F)), "vox_offset"},
    {"nifti_tiny_spacing", file("x.nii", [] {
         std::string bytes = spoiled_nifti(80, 1e-9F);
         put(bytes, 254, std::int16_t{0});
         return bytes;
     }()), "pixdim"},
    {"nifti_far_origin", file("x.nii", spoiled_nifti(292, 1e30F)), "sform"},
    {"nifti_negative_size", file("x.nii", spoiled_nifti(42, std::int16_t{-3})), "an axis of"},
    {"nifti_huge_size", file("x.nii", spoiled_nifti(42, std::array<std::int16_t, 3>{2000, 2000, 2000})), "is cut off: 120 of 16000000000 bytes"},
    {"nifti_slope_without_end", file("x.nii", spoiled_nifti(112, std::numeric_limits<float>::infinity())), "scl_slope"},
    {"nifti2_negative_offset", file("x.nii", [] {
         std::string bytes = nifti2();
         put(bytes, 168, std::int64_t{-5});
         return bytes;
     }()), "vox_offset"},

    // Compressed data that shrank too much.
    {"nrrd_gzip_bomb", large_file("x.nrrd", [] { return with(gzip_nrrd, "sizes: 3 4 5", "sizes: 3000 4000 3000") + deflated(std::string(1u << 24, '\0')); }), impossible_compression},

    // DICOM.
    {"dicom_nested_sequences", series(spoiled([](RawSlice& one) { one.before_image = nested_sequences(20'000); })), "sequences within one another"},
    {"dicom_hidden_sequences", series(spoiled([](RawSlice& one) { one.before_image = dicom_element(0x0021, 0x1001, "UN", nested_sequences(20'000)); })), "no sequences"},
    {"dicom_sequences_of_doubling_time", series(spoiled([](RawSlice& one) {
         one.after_image = dicom_element(0x5200, 0x9229, "UN", dicom_item(nested_sequences(63)));
     })),
     "sequences within one another"},
    {"dicom_implicit_nested", file("x.dcm", dicom_start(implicit_little_endian) + [] {
         std::string bytes;
         for (int i = 0; i < 20'000; ++i) bytes += dicom_tag(0x0040, 0xa730) + little(0xffffffff, 4) + dicom_open_item;
         return bytes;
     }()), "sequences within one another"},
    {"dicom_one_bit", series(spoiled([](RawSlice& one) { one.bits = 1; })), "Bits Allocated (0028,0100) is 1"},
    {"dicom_no_bits", series(spoiled([](RawSlice& one) { one.bits = 0; })), "Bits Allocated"},
    {"dicom_claims_gigabytes", series(spoiled([](RawSlice& one) { one.rows = one.columns = 46'000; })), "is cut off: 24 of 4232000000 bytes"},
    {"dicom_value_of_gigabytes", file("x.dcm", [] {
         std::string bytes = raw_dicom({});
         return bytes + dicom_element(0x7fe1, 0x0010, "OB", "", 0xfffffffe);
     }()), "cut off or damaged"},
    {"dicom_compressed_claims_gigabytes", series(spoiled([](RawSlice& one) {
         one.transfer_syntax = jpeg2000_lossless;
         one.is_encapsulated = true;
         one.rows = one.columns = 46'000;
         one.pixels = jpeg2000_start(46'000, 46'000, true) + std::string(2000, '\0');
     })), impossible_compression},
    {"dicom_codestream_of_other_size", series(spoiled([](RawSlice& one) {
         one.transfer_syntax = jpeg2000_lossless;
         one.is_encapsulated = true;
         one.pixels = jpeg2000_start(46'000, 46'000, true) + std::string(2000, '\0');
     })), "its compressed pixel data say 46000 x 46000"},
    {"dicom_segmentation", series(spoiled([](RawSlice& one) {
         one.sop_class = "1.2.840.10008.5.1.4.1.1.66.4";
         one.modality = "SEG";
     })), "is a segmentation (SEG)"},
    {"dicom_dose", series(spoiled([](RawSlice& one) { one.sop_class = "1.2.840.10008.5.1.4.1.1.481.2"; })), "radiotherapy"},
    {"dicom_far_origin", series(spoiled([](RawSlice& one) { one.position = "1e308\\0\\"; })), "the position of"},
    {"dicom_tiny_spacing", series(spoiled([](RawSlice& one) { one.spacing = "1e-9\\1e-9"; })), "pixel spacing of"},
    {"dicom_cut_in_element", file("x.dcm", raw_dicom({}).substr(0, 200)), "cut off or damaged"},
    {"dicom_folders_and_pipes",
     [](const std::filesystem::path& folder) {
         std::filesystem::create_directories(folder / "series/00.dcm");
         std::filesystem::create_symlink("loop.dcm", folder / "series/loop.dcm");
         if (::mkfifo((folder / "series/01.dcm").c_str(), 0600) != 0) throw std::runtime_error("no pipe");
         return folder / "series";
     },
     "holds no files"},
};

/// Found while the voxels are read, which is once: the estimate of memory and progress have been printed by
/// then.
const std::vector<Attack> spoiled_voxels{
    {"nrrd_gzip_wrong_crc", file("x.nrrd", gzip_nrrd + flipped(deflated(voxels), 6)), "damaged"},
    {"nrrd_gzip_cut_off", file("x.nrrd", gzip_nrrd + shorter(deflated(voxels), 4)), "cut off"},
    {"nrrd_gzip_garbage_behind", file("x.nrrd", gzip_nrrd + deflated(voxels) + "garbage"),
     "7 bytes of something else"},
    {"nrrd_gzip_more_voxels", file("x.nrrd", gzip_nrrd + deflated(voxels + voxels)),
     "more than the 120 bytes"},
    {"nifti_gzip_wrong_crc", file("x.nii.gz", flipped(deflated(nifti()), 6)), "damaged"},
    {"nifti_gzip_cut_off", file("x.nii.gz", shorter(deflated(nifti()), 4)), "cut off"},
    {"nifti_gzip_garbage_behind", file("x.nii.gz", deflated(nifti()) + "garbage"),
     "7 bytes of something else"},
    {"nifti_gzip_more_voxels", large_file("x.nii.gz", [] { return deflated(nifti(10'000'000)); }),
     "more than the 472 bytes"},
    {"mha_zlib_wrong_checksum", file("x.mha", zlib_mha + flipped(deflated(voxels, 15), 2)), "damaged"},
    {"mha_zlib_cut_off", file("x.mha", zlib_mha + shorter(deflated(voxels, 15), 2)), "cut off"},
    {"mha_zlib_garbage_behind", file("x.mha", zlib_mha + deflated(voxels, 15) + "garbage"),
     "7 bytes of something else"},
    {"mha_zlib_more_voxels", file("x.mha", zlib_mha + deflated(voxels + voxels, 15)),
     "more than the 120 bytes"},
};

class HostileImport : public ::testing::TestWithParam<Attack> {
  protected:
    TemporaryFolder folder_;
};

TEST_P(HostileImport, IsRefusedInOneLine) {
    const std::filesystem::path input = GetParam().write(folder_.path());
    const Finished said = import(input, folder_ / "bone.nrrd");
    EXPECT_EQ(said.status, 1) << said.err.substr(0, 2000);
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err.substr(0, 2000);
    EXPECT_THAT(said.err, HasSubstr("bone_import: "));
    EXPECT_THAT(said.err, HasSubstr(GetParam().reason));
    EXPECT_EQ(said.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "bone.nrrd"));
}

class SpoiledVoxels : public HostileImport {};

TEST_P(SpoiledVoxels, AreRefusedInOneLineAndLeaveNothing) {
    const std::filesystem::path input = GetParam().write(folder_.path());
    const Finished said = import(input, folder_ / "bone.nrrd");
    EXPECT_EQ(said.status, 1) << said.err.substr(0, 2000);
    const std::size_t refusal = said.err.find("bone_import: ");
    ASSERT_NE(refusal, std::string::npos) << said.err;
    EXPECT_THAT(said.err.substr(refusal), HasSubstr(GetParam().reason));
    EXPECT_EQ(said.err.find('\n', refusal), said.err.size() - 1) << said.err;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1) << "the input";
}

INSTANTIATE_TEST_SUITE_P(Of, SpoiledVoxels, ::testing::ValuesIn(spoiled_voxels),
                         [](const auto& instance) { return std::string(instance.param.name); });

INSTANTIATE_TEST_SUITE_P(Of, HostileImport, ::testing::ValuesIn(attacks),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace osteomill::hostile_import_test
