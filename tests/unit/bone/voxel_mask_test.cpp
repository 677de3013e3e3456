#include <gtest/gtest.h>

#include <vector>

#include "common/bone/brick.h"

namespace osteomill {
namespace {

std::vector<std::size_t> voxels_of(const VoxelMask& mask) {
    std::vector<std::size_t> voxels;
    mask.for_each([&](std::size_t voxel) { voxels.push_back(voxel); });
    return voxels;
}

TEST(VoxelMask, HoldsWhatWasSetInTheOrderOfTheVoxels) {
    const VoxelMask mask = VoxelMask().set(4095).set(0).set(63).set(64);
    EXPECT_EQ(voxels_of(mask), (std::vector<std::size_t>{0, 63, 64, 4095}));
    EXPECT_EQ(mask.count(), 4U);
    EXPECT_TRUE(mask[63]);
    EXPECT_FALSE(mask[62]);
}

TEST(VoxelMask, TakesNeighboursOfARow) {
    EXPECT_EQ(voxels_of(VoxelMask().set_run(61, 3)), (std::vector<std::size_t>{61, 62, 63}));
    EXPECT_EQ(voxels_of(VoxelMask().set_run(4080, 16)).front(), 4080U);
    EXPECT_EQ(VoxelMask().set_run(4080, 16).count(), 16U);
}

TEST(VoxelMask, KnowsNoneSomeAndAll) {
    EXPECT_TRUE(VoxelMask().none());
    EXPECT_TRUE(VoxelMask().set(4000).any());
    EXPECT_FALSE(VoxelMask().set(4000).all());
    EXPECT_TRUE(VoxelMask().set_all().all());
}

TEST(VoxelMask, UnitesWithAnother) {
    EXPECT_EQ(VoxelMask().set(7) | VoxelMask().set(700), VoxelMask().set(7).set(700));
}

TEST(VoxelMask, IsRebuiltFromItsWords) {
    const VoxelMask mask = VoxelMask().set_run(0, 9).set(777).set(4095);
    VoxelMask again;
    for (std::size_t n = 0; n < VoxelMask::word_count; ++n) again.set_word(n, mask.words()[n]);
    EXPECT_EQ(again, mask);
}

}  // namespace
}  // namespace osteomill
