#include <gmock/gmock.h>

#include "imaging/bone_file/removed_bone.h"
#include "imaging/imaging_error.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

class RemovedVolumes : public ::testing::Test {
  protected:
    VolumesByTissue read(const std::map<std::string, std::string>& keys) const {
        const HuVolume volume{.grid = {.size_voxels = {2, 2, 2}, .spacing_mm = 0.1, .origin_mm = {}},
                              .hu = std::vector<std::int16_t>(8, 700),
                              .tissue = {}};
        testing::write_bone_file(folder_ / "a.nrrd", volume, keys);
        return removed_before_mm3(BoneFile(folder_ / "a.nrrd"));
    }
    testing::TemporaryFolder folder_;
};

TEST_F(RemovedVolumes, ComeBackFromAFile) {
    VolumesByTissue removed_mm3{};
    removed_mm3[0] = 1.25;
    removed_mm3[7] = 1e-12;  // the error of a difference of sums
    removed_mm3[255] = 1234.567890123;
    EXPECT_EQ(text_of_removed(removed_mm3), "0:1.250000000 255:1234.567890123");
    VolumesByTissue read_back = read({{removed_key, text_of_removed(removed_mm3)}});
    EXPECT_EQ(read_back[0], 1.25);
    EXPECT_EQ(read_back[7], 0.0);
    EXPECT_EQ(read_back[255], 1234.567890123);
}

TEST_F(RemovedVolumes, AreNoneWhereTheFileTellsNothing) {
    EXPECT_EQ(read({}), VolumesByTissue{});
    EXPECT_EQ(read({{removed_key, ""}}), VolumesByTissue{});
}

TEST_F(RemovedVolumes, ThatMakeNoSenseAreRefused) {
    for (const char* text :
         {"7", "7:", "7:x", "x:1", "256:1", "0:-1", "0:nan", "0:inf", "0;1", "-1:2", "0:1 2"})
        EXPECT_THROW(read({{removed_key, text}}), ImagingError) << text;
}

}  // namespace
}  // namespace osteomill
