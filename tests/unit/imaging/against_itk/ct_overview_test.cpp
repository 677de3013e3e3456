#include <gtest/gtest.h>

#include <cmath>

#include "imaging/bone_file/bone_of_file.h"

namespace osteomill {
namespace {

/// HU that rise along each axis, slice by slice.
HuSlices ramp(const glm::ivec3& size) {
    HuSlices slices{.grid = {.size_voxels = size, .spacing_mm = 0.1, .origin_mm = {5.0, 6.0, 7.0}},
                    .labelled = false,
                    .read = {}};
    slices.read = [size, z = 0](std::span<std::int16_t> hu, std::span<std::uint8_t>) mutable {
        const std::size_t per_slice = static_cast<std::size_t>(size.x * size.y);
        for (std::size_t i = 0; i < hu.size(); ++i) {
            const int x = static_cast<int>(i % per_slice) % size.x;
            const int y = static_cast<int>(i % per_slice) / size.x;
            hu[i] = static_cast<std::int16_t>(2 * x + 6 * y + 10 * (z + static_cast<int>(i / per_slice)));
        }
        z += static_cast<int>(hu.size() / per_slice);
    };
    return slices;
}

TEST(CtOverview, IsTheCtItselfWhereThatIsSmallEnough) {
    const CtVolume ct = ct_overview(ramp({7, 5, 3}), 1000);
    EXPECT_EQ(ct.grid, (Grid{.size_voxels = {7, 5, 3}, .spacing_mm = 0.1, .origin_mm = {5.0, 6.0, 7.0}}));
    EXPECT_EQ(ct.hu[0], 0);
    EXPECT_EQ(ct.hu.back(), 2 * 6 + 6 * 4 + 10 * 2);
}

TEST(CtOverview, IsTheMeanOfAsManyVoxelsAsItMustBe) {
    const CtVolume ct = ct_overview(ramp({60, 50, 40}), 10'000);
    EXPECT_LE(ct.hu.size(), 10'000U);
    EXPECT_EQ(ct.grid.size_voxels, glm::ivec3(20, 17, 14));
    EXPECT_NEAR(ct.grid.spacing_mm, 0.3, 1e-12);
    // A ramp's mean is the ramp at the middle: the coarse voxels lie where their contents do.
    for (const glm::dvec3 at : {glm::dvec3(6.0, 7.0, 8.0), glm::dvec3(8.15, 9.05, 10.02)}) {
        const glm::dvec3 voxel = (at - glm::dvec3(5.0, 6.0, 7.0)) / 0.1;
        EXPECT_NEAR(ct.hu_at(at), 2.0 * voxel.x + 6.0 * voxel.y + 10.0 * voxel.z, 1.0);
    }
}

}  // namespace
}  // namespace osteomill
