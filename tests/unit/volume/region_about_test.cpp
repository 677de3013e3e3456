#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render_client/volume/structures/structure_surface.h"
#include "tests/support/ball_structure.h"

namespace osteomill::region_about_test {
namespace {

const Grid grid{.size_voxels = {48, 48, 48}, .spacing_mm = 0.2, .origin_mm = {-4.7, -4.7, -4.7}};

TEST(RegionAboutAStructure, HasWhatIsWithinTheDistanceAlsoBeyondItsGrid) {
    const glm::dvec3 middle_mm(-3.8, 0.0, 0.0);
    const StructureMask ball = testing::ball_mask(grid, middle_mm, 0.8);
    for (const double distance_mm : {0.0, 0.5, 2.0}) {
        const StructureMask region = region_about(ball, distance_mm);
        const double radius_mm = 0.8 + distance_mm;
        // Half a voxel of 0.2 mm for the structure's, a quarter for those of the region, which are within or
        // not.
        EXPECT_NEAR(std::cbrt(region.volume_mm3() / 4.18879), radius_mm, 0.15) << distance_mm;
        const glm::ivec3 size = region.grid().size_voxels;
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec3 voxel(x, size.y / 2, size.z / 2);
            const double far_mm = glm::distance(centre_of_voxel_mm(region.grid(), voxel), middle_mm);
            if (std::abs(far_mm - radius_mm) > 0.3) {
                EXPECT_EQ(region.contains(voxel), far_mm < radius_mm) << far_mm << " of " << radius_mm;
            }
        }
    }
}

TEST(RegionAboutAStructure, IsCoarserWhereItIsLarge) {
    const Grid large{.size_voxels = {96, 96, 96}, .spacing_mm = 0.1, .origin_mm = {-4.75, -4.75, -4.75}};
    const StructureMask region = region_about(testing::ball_mask(large, glm::dvec3(0.0), 4.0), 5.0);
    EXPECT_GT(region.grid().spacing_mm, 0.12);
    EXPECT_NEAR(region.volume_mm3() / (4.18879 * 729.0), 1.0, 0.05);
    EXPECT_TRUE(region_about(StructureMask(), 1.0).empty());
}

}  // namespace
}  // namespace osteomill::region_about_test
