#include "imaging/phantoms/head_phantom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace osteomill {
namespace {

/// The head's braincase, as thick as two and a half voxels of a coarse grid that reaches just round it.
Braincase coarse() {
    return {.grid = {.size_voxels = {86, 106, 90}, .spacing_mm = 1.8, .origin_mm = {-76.5, -94.5, -80.1}},
            .outer_radii_mm = head_braincase().outer_radii_mm,
            .thickness_mm = 4.5};
}

double volume_mm3(const Braincase& shape) {
    const auto ellipsoid_mm3 = [](const glm::dvec3& r) {
        return 4.0 / 3.0 * std::numbers::pi * r.x * r.y * r.z;
    };
    return ellipsoid_mm3(shape.outer_radii_mm) - ellipsoid_mm3(shape.outer_radii_mm - shape.thickness_mm);
}

TEST(Braincase, HasTheVolumeOfItsShell) {
    const Braincase shape = coarse();
    EXPECT_NEAR(bone_volume_mm3(make_braincase(shape)) / volume_mm3(shape), 1.0, 0.001);
}

TEST(Braincase, IsBoneBetweenItsSurfacesAndPartlyOnThem) {
    const Braincase shape = coarse();
    const Bone bone = make_braincase(shape);
    const Grid& grid = bone.grid();
    for (int axis = 0; axis < 3; ++axis) {
        // Outwards along an axis: all that lies within half a voxel of a surface, and nothing else, is
        // partial.
        glm::ivec3 voxel(to_voxel_coordinates(grid, glm::dvec3(0.0)) + 0.5);
        for (; voxel[axis] < grid.size_voxels[axis]; ++voxel[axis]) {
            const double at_mm = centre_of_voxel_mm(grid, voxel)[axis];
            const double outer_mm = shape.outer_radii_mm[axis];
            const double inside_mm = std::min(outer_mm - at_mm, at_mm - (outer_mm - shape.thickness_mm));
            const double expected = 255.0 * std::clamp(0.5 + inside_mm / grid.spacing_mm, 0.0, 1.0);
            EXPECT_NEAR(bone.fraction_at(voxel), expected, 3.0)
                << "axis " << axis << " at " << at_mm << " mm";
        }
    }
}

TEST(Braincase, IsHomogeneousAndStoresOnlyBricksWithBone) {
    const Bone bone = make_braincase(coarse());
    EXPECT_TRUE(bone.content().stiffness.empty());
    EXPECT_TRUE(bone.content().tissue.empty());
    EXPECT_DOUBLE_EQ(bone.content().homogeneous_stiffness, 1.0);
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
        EXPECT_TRUE(std::any_of(fractions.begin(), fractions.end(), [](std::uint8_t f) { return f > 0; }));
    }
}

TEST(Braincase, TakesNoMoreMemoryInALargerGrid) {
    const Braincase shape = coarse();
    const Bone bone = make_braincase(shape);
    Braincase larger = shape;
    larger.grid.size_voxels *= 3;
    larger.grid.origin_mm -= static_cast<double>(brick_edge_voxels) * 4.0 * shape.grid.spacing_mm;
    const Bone in_larger = make_braincase(larger);
    EXPECT_EQ(bone_volume_mm3(in_larger), bone_volume_mm3(bone));
    EXPECT_EQ(memory_bytes(in_larger), memory_bytes(bone));
}

TEST(Braincase, OfTheHeadFillsTwoPercentOfItsGrid) {
    const Braincase shape = head_braincase();
    EXPECT_EQ(shape.grid.size_voxels, glm::ivec3(2048));
    EXPECT_DOUBLE_EQ(shape.grid.spacing_mm, 0.1);
    EXPECT_NEAR(volume_mm3(shape) / std::pow(204.8, 3), 0.02, 0.0005);
    const glm::dvec3 reach_mm = -shape.grid.origin_mm;
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(shape.outer_radii_mm[axis], reach_mm[axis]);
}

TEST(Braincase, RefusesAShellThatIsNone) {
    for (const double thickness_mm : {0.0, -1.0, 74.0, std::nan("")}) {
        Braincase shape = coarse();
        shape.thickness_mm = thickness_mm;
        EXPECT_THROW((void)make_braincase(shape), std::invalid_argument) << thickness_mm;
    }
}

}  // namespace
}  // namespace osteomill
