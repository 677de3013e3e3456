#include "imaging/formats/plausible_geometry.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/support/message_of.h"

namespace osteomill::plausible_geometry_test {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::function<void(SourceImage&)>& spoil) {
    SourceImage image{.size_voxels = {3, 4, 5}};
    spoil(image);
    return testing::message_of<std::invalid_argument>([&] { require_plausible_geometry(image); });
}

TEST(PlausibleGeometry, AcceptsWhatScannersMake) {
    EXPECT_EQ(refusal([](SourceImage&) {}), "");
    EXPECT_EQ(refusal([](SourceImage& image) { image.spacing_mm = {0.005, 0.005, 10.0}; }), "");
    EXPECT_EQ(refusal([](SourceImage& image) { image.origin_mm = {-3000.0, 400.0, 2.5}; }), "");
}

TEST(PlausibleGeometry, RefusesSpacingsOriginsAndSizesThatNoScanHas) {
    for (const double spacing_mm : {1e-9, 1e9, 0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                    std::numeric_limits<double>::infinity()})
        EXPECT_THAT(refusal([&](SourceImage& image) { image.spacing_mm.y = spacing_mm; }),
                    HasSubstr("spacing of axis 1"));
    for (const double origin_mm : {1e308, -2e6, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THAT(refusal([&](SourceImage& image) { image.origin_mm.z = origin_mm; }),
                    HasSubstr("its origin"));
    for (const int size : {-1, 0, 70'000})
        EXPECT_THAT(refusal([&](SourceImage& image) { image.size_voxels.x = size; }),
                    HasSubstr("an axis of"));
    EXPECT_THAT(refusal([](SourceImage& image) {
                    image.size_voxels = {60'000, 60'000, 60'000};
                }),
                HasSubstr("more than"));
}

TEST(PlausibleGeometry, RefusesAxesThatAreNotPerpendicular) {
    EXPECT_THAT(refusal([](SourceImage& image) {
                    image.direction[1] = {0.5, 1.0, 0.0};
                }),
                HasSubstr("not perpendicular"));
    EXPECT_THAT(
        refusal([](SourceImage& image) { image.direction[2].x = std::numeric_limits<double>::quiet_NaN(); }),
        HasSubstr("is not a number"));
}

TEST(PlausibleGeometry, CountsVoxelsWithoutOverflow) {
    EXPECT_EQ(plausible_voxel_count(std::vector<std::uint64_t>{3, 4, 5}), 60u);
    EXPECT_THROW(plausible_voxel_count(std::vector<std::uint64_t>(16, 65535)), std::invalid_argument);
    EXPECT_THROW(plausible_voxel_count(std::vector<std::uint64_t>{~std::uint64_t{0}, 2}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::plausible_geometry_test
