#include "imaging/resampling/region.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace osteomill {
namespace {

TEST(Region, IsParsedFromSixNumbers) {
    const ScanRegion region = parse_region("-1,2,3.5,4,5,6");
    EXPECT_EQ(region.low_mm, glm::dvec3(-1.0, 2.0, 3.5));
    EXPECT_EQ(region.high_mm, glm::dvec3(4.0, 5.0, 6.0));
    for (const char* wrong :
         {"", "1,2,3", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,3,0,5,6", "nan,2,3,4,5,6", "1,,3,4,5,6"})
        EXPECT_THROW(parse_region(wrong), std::invalid_argument) << wrong;
}

TEST(Region, OutsideTheImageIsRefusedNamingWhatTheImageCovers) {
    const ScanRegion extent{.low_mm = {0.0, 0.0, 0.0}, .high_mm = {10.0, 10.0, 10.0}};
    EXPECT_EQ(clip({{-5.0, 1.0, 1.0}, {5.0, 2.0, 20.0}}, extent),
              (ScanRegion{{0.0, 1.0, 1.0}, {5.0, 2.0, 10.0}}));
    try {
        clip({{20.0, 1.0, 1.0}, {25.0, 2.0, 2.0}}, extent);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("0.0,0.0,0.0,10.0,10.0,10.0"));
    }
}

TEST(Region, HoldsTheCentresOfItsGrid) {
    const Grid grid = grid_over({{1.0, 2.0, 3.0}, {2.0, 2.95, 3.1}}, 0.1);
    EXPECT_EQ(grid.size_voxels, glm::ivec3(11, 10, 2));
    EXPECT_EQ(grid.origin_mm, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_THROW(grid_over({{0.0, 0.0, 0.0}, {7000.0, 1.0, 1.0}}, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill
