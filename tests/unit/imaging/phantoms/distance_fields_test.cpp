#include "imaging/phantoms/distance_fields.h"

#include <gtest/gtest.h>

namespace osteomill::distance_field {
namespace {

TEST(DistanceFields, AreExactWhereTheyShouldBe) {
    EXPECT_DOUBLE_EQ(rounded_box({5.0, 0.0, 0.0}, {2.0, 3.0, 4.0}, 0.5), 3.0);
    EXPECT_DOUBLE_EQ(rounded_box({0.0, 0.0, 0.0}, {2.0, 3.0, 4.0}, 0.5), -2.0);
    EXPECT_NEAR(ellipsoid({0.0, 3.0, 0.0}, {2.0, 3.0, 4.0}), 0.0, 1e-12);
    EXPECT_LT(ellipsoid({0.0, 0.0, 0.0}, {2.0, 3.0, 4.0}), 0.0);
    EXPECT_NEAR(round_cone({1.5, 0.0, 0.0}, {0, 0, 0}, {0, 0, 4}, 1.0, 0.5), 0.5, 1e-12);
    EXPECT_NEAR(round_cone({0.0, 0.0, 5.0}, {0, 0, 0}, {0, 0, 4}, 1.0, 0.5), 0.5, 1e-12);
}

TEST(DistanceFields, BlendedUnionOnlyAddsAndBlendedIntersectionOnlyTakes) {
    for (double a = -2.0; a <= 2.0; a += 0.25)
        for (double b = -2.0; b <= 2.0; b += 0.25) {
            EXPECT_LE(smooth_union(a, b, 0.5), std::min(a, b));
            EXPECT_GE(smooth_intersection(a, b, 0.5), std::max(a, b));
        }
    EXPECT_EQ(smooth_union(0.0, 1.0, 0.5), 0.0) << "no blend far from the edge";
}

}  // namespace
}  // namespace osteomill::distance_field
