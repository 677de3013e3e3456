#include "imaging/resampling/field_of_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "imaging/bone_from_hu.h"
#include "imaging/resampling/refine.h"

namespace osteomill {
namespace {

constexpr float not_measured = std::numeric_limits<float>::quiet_NaN();
constexpr int edge = 24;

/// Soft tissue of 40 HU with a post of 1500 HU in its middle, measured within a cylinder.
std::vector<float> cylinder(float around) {
    std::vector<float> values;
    for (int k = 0; k < edge; ++k)
        for (int j = 0; j < edge; ++j)
            for (int i = 0; i < edge; ++i) {
                const double r = std::hypot(i - 11.5, j - 11.5);
                values.push_back(r > 10.0 ? around : r < 3.0 ? 1500.0F : 40.0F);
            }
    return values;
}

SourceImage whole() {
    return {.size_voxels = {edge, edge, edge}, .spacing_mm = glm::dvec3(0.5)};
}

TEST(FieldOfView, LetsNoBoneComeOfItsEdge) {
    const SourceImage part = whole();
    const Grid fine{.size_voxels = {116, 116, 116}, .spacing_mm = 0.1, .origin_mm = {}};
    std::vector<float> values = cylinder(not_measured);
    std::vector<std::byte> room(values.size() / 8 + 1);
    const FieldOfView field(part, values, room);
    EXPECT_GT(field.voxels_outside(), 0u);
    for (const float value : values) ASSERT_FALSE(std::isnan(value));
    const Refiner refiner(part, values, fine);
    std::vector<std::int16_t> hu(116u * 116u);
    refiner.slice(58, hu);
    field.clear_outside(fine, 58, hu);
    int highest_of_tissue = air_hu;
    for (int y = 0; y < 116; ++y)
        for (int x = 0; x < 116; ++x) {
            const double r_mm = std::hypot(0.1 * x - 5.75, 0.1 * y - 5.75);
            const int here = hu[static_cast<std::size_t>(x + 116 * y)];
            if (r_mm > 2.5) highest_of_tissue = std::max(highest_of_tissue, here);
            if (r_mm > 5.4) {
                EXPECT_EQ(here, air_hu) << x << " " << y;
            }
            if (r_mm > 3.0 && r_mm < 4.6) {
                EXPECT_NEAR(here, 40, 45) << x << " " << y;
            }
        }
    EXPECT_LT(highest_of_tissue, 150) << "the post's own overshoot";
}

TEST(FieldOfView, ChangesNothingWhereAllWasMeasured) {
    std::vector<float> values = cylinder(-1000.0F);
    const std::vector<float> before = values;
    std::vector<std::byte> room(values.size() / 8 + 1);
    const FieldOfView field(whole(), values, room);
    EXPECT_EQ(field.voxels_outside(), 0u);
    EXPECT_EQ(values, before);
}

TEST(FieldOfView, OfNothingIsAir) {
    std::vector<float> values(static_cast<std::size_t>(edge * edge * edge), not_measured);
    std::vector<std::byte> room(values.size() / 8 + 1);
    const FieldOfView field(whole(), values, room);
    EXPECT_EQ(field.voxels_outside(), values.size());
    for (const float value : values) ASSERT_EQ(value, static_cast<float>(air_hu));
}

}  // namespace
}  // namespace osteomill
