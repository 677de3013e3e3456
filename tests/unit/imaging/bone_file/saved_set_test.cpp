#include "imaging/bone_file/saved_set.h"

#include <gmock/gmock.h>

#include "imaging/bone_file/carved_bone.h"
#include "imaging/imaging_error.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

// Saved by 0.1: heterogeneous, labelled, half milled away.
class SavedSet : public ::testing::Test {
  protected:
    SavedSet() { std::filesystem::copy(OSTEOMILL_TEST_DATA "/saved_set_0_1", folder_.path()); }
    std::string refusal() const {
        try {
            restore_carved_bone(BoneFile(path_));
        } catch (const ImagingError& error) {
            return error.what();
        }
        return "accepted";
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "carved.nrrd";
};

TEST_F(SavedSet, ComesBackAsItWasSaved) {
    const BoneFile file(path_);
    ASSERT_TRUE(is_carved(file));
    EXPECT_EQ(file.threshold_hu(), 300.0);
    const Bone bone = restore_carved_bone(file).bone;
    EXPECT_EQ(checksum(bone), 0x7c02bd3a1dce0d52U);
    EXPECT_EQ(bone.fraction_at({20, 17, 16}), 77);
    EXPECT_EQ(bone.fraction_at({21, 17, 16}), 0);
    EXPECT_EQ(bone.tissue_at({18, 17, 16}), 2);
    EXPECT_EQ(bone.tissue_at({10, 17, 16}), 1);
    EXPECT_NEAR(bone.stiffness_at({18, 17, 16}), relative_stiffness(default_stiffness_relation(), 1900.0),
                0.5 * stiffness_per_code);
}

TEST_F(SavedSet, GivesWayToOneFile) {
    const BoneFile file(path_);
    const Bone bone = restore_carved_bone(file).bone;
    HuReader reader(file);
    save_carved_bone(path_, slices_of(reader, file), bone);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
    const Bone again = restore_carved_bone(BoneFile(path_)).bone;
    EXPECT_EQ(checksum(again), checksum(bone));
    EXPECT_EQ(again.content().stiffness, bone.content().stiffness);
    EXPECT_EQ(again.content().tissue, bone.content().tissue);
}

TEST_F(SavedSet, LeavesFilesThatItsHeaderDoesNotName) {
    EXPECT_EQ(files_of_saved_set(path_).size(), 3u);
    EXPECT_TRUE(files_of_saved_set(folder_ / "carved.fraction.nrrd").empty());
    EXPECT_TRUE(files_of_saved_set(folder_ / "nothing.nrrd").empty());
    std::filesystem::rename(path_, folder_ / "moved.nrrd");
    EXPECT_TRUE(files_of_saved_set(folder_ / "moved.nrrd").empty()) << "they may belong to another";
}

TEST_F(SavedSet, SaysWhatIsMissingOrDoesNotFit) {
    std::filesystem::copy(folder_ / "carved.tissue.nrrd", folder_ / "carved.fraction.nrrd",
                          std::filesystem::copy_options::overwrite_existing);
    EXPECT_THAT(refusal(), HasSubstr("of another carving"));
    std::filesystem::resize_file(folder_ / "carved.fraction.nrrd", 400);
    EXPECT_THAT(refusal(), HasSubstr("cut off"));
    std::filesystem::remove(folder_ / "carved.fraction.nrrd");
    EXPECT_THAT(refusal(), HasSubstr("carved.fraction.nrrd is missing"));
}

}  // namespace
}  // namespace osteomill
