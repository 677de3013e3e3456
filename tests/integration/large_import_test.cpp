// Scans that are larger than what the importer may hold, and the real bone_import: it reads them slab by slab.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <fstream>

#include "tests/support/child_process.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/raw_images.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using namespace testing;

constexpr std::int16_t columns = 720;
constexpr std::int16_t rows = 720;
constexpr std::int16_t slices = 520;
constexpr std::size_t voxel_bytes = 2u * columns * rows * slices;  // 514 MiB; read as a whole, 2.5 GiB
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
    /// Imports a corner of it.
    void expect_import(const std::filesystem::path& input) {
        const Finished said =
            run_program({BONE_IMPORT, input.string(), (folder_ / "bone.nrrd").string(), "--spacing-mm", "2",
                         "--region", "-30,-40,30,-10,-20,50"},
                        std::chrono::seconds(120));
        ASSERT_EQ(said.status, 0) << said.err;
        EXPECT_THAT(read_bone_file(folder_ / "bone.nrrd").volume.hu, ::testing::Each(300));
        if (BOUNDS_MEMORY) {
            EXPECT_LT(peak_of_children(), most_bytes);
        }
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

}  // namespace
}  // namespace osteomill
