// The removed bone, read back by ITK, which reads NRRD with teem's code, as 3D Slicer does.
#include "imaging/bone_file/removed_bone.h"

#include <gtest/gtest.h>
#include <itkImageFileReader.h>
#include <itkNrrdImageIO.h>

#include <random>
#include <stdexcept>

#include "imaging/imaging_error.h"
#include "tests/support/speckled_bone.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

/// Takes a share of every third voxel at random.
void carve(Bone& bone, std::mt19937& random) {
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        for (std::uint8_t& fraction : bone.fractions(static_cast<std::int32_t>(slot)))
            if (random() % 3 == 0) fraction = static_cast<std::uint8_t>(random() % (1U + fraction));
}

TEST(RemovedBone, LiesInThePatientAsTheBoneDoes) {
    const testing::TemporaryFolder folder;
    std::mt19937 random(11);
    const Bone before = testing::make_speckled_bone(random, {.filled_bricks = 0.5});
    Bone after = before;
    carve(after, random);
    save_removed(folder / "gone.nrrd", before, after);

    using Image = itk::Image<std::uint8_t, 3>;
    const auto reader = itk::ImageFileReader<Image>::New();
    reader->SetImageIO(itk::NrrdImageIO::New());
    reader->SetFileName((folder / "gone.nrrd").string());
    reader->Update();
    const Image* image = reader->GetOutput();
    const Grid& grid = before.grid();
    for (int axis = 0; axis < 3; ++axis) {
        const auto itk_axis = static_cast<unsigned>(axis);
        EXPECT_EQ(image->GetSpacing()[itk_axis], grid.spacing_mm);
        EXPECT_EQ(image->GetOrigin()[itk_axis], grid.origin_mm[axis]);
        EXPECT_EQ(image->GetDirection()[itk_axis][itk_axis], 1.0);
        ASSERT_EQ(image->GetBufferedRegion().GetSize()[itk_axis],
                  static_cast<unsigned>(grid.size_voxels[axis]));
    }
    const std::uint8_t* gone = image->GetBufferPointer();
    for (int z = 0; z < grid.size_voxels.z; ++z)
        for (int y = 0; y < grid.size_voxels.y; ++y)
            for (int x = 0; x < grid.size_voxels.x; ++x)
                ASSERT_EQ(*gone++, before.fraction_at({x, y, z}) - after.fraction_at({x, y, z}));
}

TEST(RemovedBone, IsOnlyOfABoneThatWasCarved) {
    const testing::TemporaryFolder folder;
    std::mt19937 random(12);
    const Bone before = testing::make_speckled_bone(random);
    Bone after = before;
    EXPECT_FALSE(first_risen_voxel(before, after));
    carve(after, random);
    EXPECT_FALSE(first_risen_voxel(before, after));
    EXPECT_TRUE(first_risen_voxel(after, before));
    const Bone other = testing::make_speckled_bone(random, {.grid = {.size_voxels = {20, 20, 20}}});
    EXPECT_THROW(save_removed(folder / "gone.nrrd", before, other), std::invalid_argument);
    EXPECT_THROW(save_removed(folder / "gone.png", before, after), ImagingError);
}

}  // namespace
}  // namespace osteomill
