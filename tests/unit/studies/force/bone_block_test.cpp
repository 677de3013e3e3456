#include "studies/force/bone_block.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace osteomill::study {
namespace {

TEST(VoxelisedBlock, MeetsAPlaneAlongTheLatticeExactly) {
    const Bone bone = voxelised({.low_mm = {-0.33, -0.2, -0.4}, .high_mm = {0.3, 0.2, 0.2}}, 0.1);
    EXPECT_EQ(bone.grid().size_voxels, glm::ivec3(7, 4, 6)) << "grown outward to whole multiples";
    for (int z = 0; z < 6; ++z) EXPECT_EQ(bone.fraction_at({3, 2, z}), z < 4 ? 255 : 0) << z;
    EXPECT_NEAR(bone_volume_mm3(bone), 0.7 * 0.4 * 0.4, 1e-9);
}

TEST(VoxelisedBlock, HoldsTheVolumeBelowATiltedPlane) {
    // A plane through the centre of a cube halves it, however it tilts.
    for (const glm::dvec3 up : {glm::dvec3(1, 2, 3), glm::dvec3(-1, 0.1, 0), glm::dvec3(1, 1, 1)}) {
        const Bone bone = voxelised(
            {.low_mm = glm::dvec3(-1.0), .high_mm = glm::dvec3(1.0), .up = glm::normalize(up)}, 0.1);
        EXPECT_NEAR(bone_volume_mm3(bone), 4.0, 0.004);
    }
}

TEST(VoxelisedBlock, FillsACutVoxelByItsShare) {
    // 45 degrees through a voxel's centre: half of it.
    const glm::dvec3 up = glm::normalize(glm::dvec3(1.0, 0.0, -1.0));
    const Bone bone = voxelised({.low_mm = glm::dvec3(0.0), .high_mm = glm::dvec3(0.4), .up = up}, 0.1);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(bone.fraction_at({i, 1, i}), 127.5, 1.0);
    EXPECT_EQ(bone.fraction_at({0, 1, 2}), 255);
    EXPECT_EQ(bone.fraction_at({2, 1, 0}), 0);
}

TEST(VoxelisedBlock, HoldsTheVolumeBelowAPlaneThatPointsAnywhere) {
    // A plane through the middle of a cube about the origin halves it, wherever it points.
    for (const glm::dvec3 up :
         {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 1.0, 0.0), glm::dvec3(1.0, 1.0, 1.0),
          glm::dvec3(0.2, -0.5, 0.8), glm::dvec3(-3.0, 1.0, 0.001)}) {
        const Bone bone = voxelised(
            {.low_mm = glm::dvec3(-0.8), .high_mm = glm::dvec3(0.8), .up = glm::normalize(up)}, 0.1);
        EXPECT_NEAR(bone_volume_mm3(bone) / (0.5 * 1.6 * 1.6 * 1.6), 1.0, 1e-3);
    }
}

}  // namespace
}  // namespace osteomill::study
