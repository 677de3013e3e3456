// Scans larger than the importer's memory may be, and the real bone_import: it reads them slab by slab.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/raw_dicom.h"
#include "tests/support/raw_images.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::large_import_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;

constexpr std::int16_t columns = 720;
constexpr std::int16_t rows = 720;
constexpr std::int16_t slices = 320;
constexpr std::size_t voxel_bytes = 2u * columns * rows * slices;  // 316 MiB; read as a whole, 1.5 GiB
constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20;

/// Peak resident bytes of the largest child so far.
std::uint64_t peak_of_children() {
    rusage used{};
    ::getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
}

class LargeImport : public ::testing::Test {
  protected:
    /// The header of a NIfTI of zeros in voxels of 2 mm, with a rescale to 300 HU.
    static std::string header() {
        std::string bytes = nifti(0);
        put(bytes, 42, std::array{columns, rows, slices});
        put(bytes, 112, std::array{2.0F, 300.0F});
        return bytes;
    }
    /// Imports a corner of it, mm.
    void expect_import(const std::filesystem::path& input,
                       const std::string& region = "-30,-40,30,-10,-20,50", int hu = 300) {
        const Finished said = run_program({BONE_IMPORT, input.string(), (folder_ / "bone.nrrd").string(),
                                           "--spacing-mm", "2", "--region", region},
                                          std::chrono::seconds(120));
        ASSERT_EQ(said.status, 0) << said.err;
        EXPECT_THAT(read_bone_file(folder_ / "bone.nrrd").volume.hu, Each(hu));
        if (BOUNDS_MEMORY) {
            EXPECT_LT(peak_of_children(), most_bytes);
        }
    }
    /// The message about a file that must be refused before its pixels are read.
    std::string refusal(const std::filesystem::path& input, const std::vector<std::string>& options) {
        std::vector<std::string> command{BONE_IMPORT, input.string(), (folder_ / "bone.nrrd").string()};
        command.insert(command.end(), options.begin(), options.end());
        const Finished said = run_program(command, std::chrono::seconds(120));
        EXPECT_EQ(said.status, 1);
        if (BOUNDS_MEMORY) {
            EXPECT_LT(peak_of_children(), most_bytes);
        }
        return said.err;
    }
    TemporaryFolder folder_;
};

TEST_F(LargeImport, ReadsANiftiInBoundedMemory) {
    write_bytes(folder_ / "large.nii", header());
    std::filesystem::resize_file(folder_ / "large.nii", 352 + voxel_bytes);
    expect_import(folder_ / "large.nii");
}

TEST_F(LargeImport, ReadsACompressedNiftiInBoundedMemory) {
    constexpr std::size_t member_bytes = 2u * columns * rows;
    const std::string member = deflated(std::string(member_bytes, '\0'));
    {
        std::ofstream file(folder_ / "large.nii.gz", std::ios::binary);
        file << deflated(header());
        for (int k = 0; k < slices; ++k) file << member;
    }
    expect_import(folder_ / "large.nii.gz");
}

/// A multi-frame file, as cone-beam scanners write it.
TEST_F(LargeImport, ReadsTheFramesOfADicomFileInBoundedMemory) {
    std::vector<int> z_mm;
    for (int k = 0; k < slices; ++k) z_mm.push_back(2 * k);
    RawSlice file = multi_frame(z_mm);
    file.columns = columns;
    file.rows = rows;
    file.pixels.clear();
    file.pixel_bytes = voxel_bytes;
    const std::string header = raw_dicom(file);
    write_bytes(folder_ / "large.dcm", header);
    std::filesystem::resize_file(folder_ / "large.dcm", header.size() + voxel_bytes);
    expect_import(folder_ / "large.dcm", "100,100,100,120,120,120", -1000);
}

/// Frames that are compressed together would be held in memory together.
TEST_F(LargeImport, RefusesCompressedFramesOfMoreThanAnImportMayTake) {
    RawSlice file = multi_frame(std::vector<int>(400));
    file.transfer_syntax = jpeg2000_lossless;
    file.columns = file.rows = 700;
    file.is_encapsulated = true;
    file.pixels = jpeg2000_start(700, 700, true) + std::string(1 << 20, '\0');
    std::vector<int> z_mm;
    for (int k = 0; k < 400; ++k) z_mm.push_back(k);
    file.after_image = multi_frame(z_mm).after_image;
    std::string fragments = dicom_item(file.pixels);
    for (int k = 1; k < 400; ++k) fragments += dicom_item("\xff\xd9");
    write_bytes(folder_ / "compressed.dcm", with(raw_dicom(file), dicom_item(file.pixels), fragments));
    EXPECT_THAT(refusal(folder_ / "compressed.dcm", {"--spacing-mm", "1"}),
                AllOf(HasSubstr("compressed.dcm: has pixels of which 1.8 GiB would be held at once"),
                      HasSubstr("one file a slice")));
}

TEST_F(LargeImport, RefusesAGridWhoseSlicesAreMoreThanAnImportMayTake) {
    std::string bytes = header();
    put(bytes, 80, std::array{2.0F, 2.0F, 2.0F});
    write_bytes(folder_ / "wide.nii", bytes);
    std::filesystem::resize_file(folder_ / "wide.nii", 352 + voxel_bytes);
    EXPECT_THAT(
        refusal(folder_ / "wide.nii", {"--spacing-mm", "0.05", "--region", "-1e9,-1e9,30,1e9,1e9,31"}),
        AllOf(HasSubstr("GiB of memory, where an import may take 1.5"),
              HasSubstr("smaller --region or a larger --spacing-mm")));
}

/// A cube of bone of so many voxels an edge in sixteen layers, each a tissue, as a case.
void make_layered_case(const TemporaryFolder& folder, const std::string& name, int edge) {
    const std::string sizes = fmt::format("{0} {0} {0}", edge);
    const auto write = [&](const std::string& file, const char* type, const std::string& keys, auto value) {
        std::ofstream out(folder / file, std::ios::binary);
        out << "NRRD0004\ntype: " << type
            << "\ndimension: 3\nspace: left-posterior-superior\nsizes: " << sizes
            << "\nspace directions: (0.2,0,0) (0,0.2,0) (0,0,0.2)\nspace origin: (0,0,0)\nencoding: raw\n"
            << "endian: little\n"
            << keys << '\n';
        for (int z = 0; z < edge; ++z) {
            const std::vector<decltype(value(0))> slice(static_cast<std::size_t>(edge * edge), value(z));
            out.write(reinterpret_cast<const char*>(slice.data()),
                      static_cast<std::streamsize>(slice.size() * sizeof slice[0]));
        }
    };
    std::string segments;
    for (int i = 0; i < 16; ++i)
        segments += fmt::format("Segment{0}_Name:=tissue {1}\nSegment{0}_LabelValue:={1}\n", i, i + 1);
    write(name + ".nrrd", "int16", "", [](int z) { return static_cast<std::int16_t>(700 + z); });
    write(name + ".seg.nrrd", "uint8", segments,
          [&](int z) { return static_cast<std::uint8_t>(1 + 16 * z / edge); });
    const Finished said =
        run_program({BONE_IMPORT, (folder / (name + ".nrrd")).string(), "--case", (folder / name).string(),
                     "--segmentation", (folder / (name + ".seg.nrrd")).string(), "--spacing-mm", "0.2",
                     "--threshold-hu", "300"},
                    std::chrono::seconds(300));
    ASSERT_EQ(said.status, 0) << said.err;
}

/// The peak memory of a session that ends as soon as it has begun.
std::uint64_t peak_of_session(const std::filesystem::path& case_folder) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::execl(HAPTIC_SERVER, HAPTIC_SERVER, "--case", case_folder.c_str(), "--clock", "virtual",
                "--duration-s", "0.01", "--listen", "127.0.0.1:0", nullptr);
        ::_exit(127);
    }
    int status = -1;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    EXPECT_EQ(status, 0);
    return static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
}

TEST(LargeCase, OfSixteenTissuesIsLoadedInFewBytesAVoxel) {
    const TemporaryFolder folder;
    constexpr int small = 32;
    constexpr int large = 224;
    make_layered_case(folder, "small", small);
    make_layered_case(folder, "large", large);
    if (!BOUNDS_MEMORY) return;
    const std::uint64_t of_program = peak_of_session(folder / "small");
    const std::uint64_t of_all = peak_of_session(folder / "large");
    constexpr double more_voxels = 1.0 * large * large * large - 1.0 * small * small * small;
    // Fraction and label, and again of the copy that is shown; each tissue's own mask would be 2 more.
    EXPECT_LT(static_cast<double>(of_all - of_program) / more_voxels, 5.0);
}

}  // namespace
}  // namespace osteomill::large_import_test
