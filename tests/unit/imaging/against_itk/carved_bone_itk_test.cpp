// ITK reads with teem's code, as 3D Slicer does.
#include <gtest/gtest.h>
#include <itkImageFileReader.h>
#include <itkNrrdImageIO.h>

#include <algorithm>

#include "imaging/bone_file/carved_bone.h"
#include "tests/support/dense_bone_file.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

TEST(CarvedBoneInItk, ShowsItsHuWhereTheyLieInThePatient) {
    const testing::TemporaryFolder folder;
    const Grid grid{.size_voxels = {37, 35, 33}, .spacing_mm = 0.1, .origin_mm = {1.0, -2.0, 3.0}};
    HuVolume volume{.grid = grid, .hu = {}, .tissue = {}};
    for (int i = 0; i < 37 * 35 * 33; ++i)
        volume.hu.push_back(static_cast<std::int16_t>(i * 7919 % 3000 - 1000));
    const Bone bone = bone_from_hu(volume, 300.0, default_stiffness_relation());
    const std::filesystem::path path = folder / "carved.nrrd";
    save_carved_bone(path, slices_of(volume), bone, {{threshold_key, "300"}});
    ASSERT_GT(BoneFile(path).form().bytes_before_voxels, 0u);

    using Image = itk::Image<std::int16_t, 3>;
    const auto reader = itk::ImageFileReader<Image>::New();
    reader->SetImageIO(itk::NrrdImageIO::New());
    reader->SetFileName(path.string());
    reader->Update();
    const Image* image = reader->GetOutput();
    ASSERT_EQ(image->GetBufferedRegion().GetNumberOfPixels(), volume.hu.size());
    const std::vector<std::int16_t> hu = testing::read_bone_file(path).volume.hu;
    EXPECT_TRUE(std::equal(hu.begin(), hu.end(), image->GetBufferPointer()));
    for (unsigned axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(image->GetSpacing()[axis], 0.1);
        EXPECT_EQ(image->GetOrigin()[axis], grid.origin_mm[static_cast<int>(axis)]);
        EXPECT_EQ(image->GetDirection()[axis][axis], 1.0);
    }
}

}  // namespace
}  // namespace osteomill
