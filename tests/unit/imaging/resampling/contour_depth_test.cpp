#include "imaging/resampling/contour_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace osteomill::contour_depth_test {
namespace {

constexpr double threshold_hu = 300.0;
constexpr double reach_mm = 6.0;

std::vector<float> depths(const SlicePixels& slice) {
    std::vector<float> depth_mm(slice.hu.size(), -99.0F);
    contour_depth_mm(slice, threshold_hu, reach_mm, depth_mm);
    return depth_mm;
}

TEST(ContourDepth, OfADiscIsRightToAFewHundredthsOfAPixel) {
    constexpr int columns = 61;
    constexpr int rows = 47;
    constexpr double column_mm = 0.4;
    constexpr double row_mm = 0.5;
    constexpr double radius_mm = 5.13;
    const auto exact_mm = [&](int column, int row) {
        return radius_mm - std::hypot(column * column_mm - 12.07, row * row_mm - 11.61);
    };
    std::vector<float> hu;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            hu.push_back(
                static_cast<float>(threshold_hu + 800.0 * std::clamp(exact_mm(column, row), -1.0, 1.0)));
    const std::vector<float> depth_mm =
        depths({.columns = columns, .rows = rows, .column_mm = column_mm, .row_mm = row_mm, .hu = hu});
    auto depth = depth_mm.begin();
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            ASSERT_NEAR(*depth++, std::max(exact_mm(column, row), -reach_mm), 0.02) << column << ' ' << row;
}

TEST(ContourDepth, OfASliceWithoutContourIsTheReach) {
    const std::vector<float> bone(20, 300.0F);
    const std::vector<float> air(20, 299.0F);
    for (const float depth : depths({.columns = 5, .rows = 4, .hu = bone})) EXPECT_FLOAT_EQ(depth, 6.0F);
    for (const float depth : depths({.columns = 5, .rows = 4, .hu = air})) EXPECT_FLOAT_EQ(depth, -6.0F);
    for (const float depth : depths({.columns = 1, .rows = 20, .hu = air})) EXPECT_FLOAT_EQ(depth, -6.0F);
}

TEST(ContourDepth, OfBoneThatTouchesInACornerSeesBothContours) {
    //   300 is half of it, so every crossing lies in the middle between two pixels.
    const std::vector<float> hu{600.0F, 0.0F,  //
                                0.0F, 600.0F};
    const float half_a_diagonal_mm = std::sqrt(0.125F);
    const std::vector<float> depth_mm = depths({.columns = 2, .rows = 2, .hu = hu});
    EXPECT_FLOAT_EQ(depth_mm[1], -half_a_diagonal_mm) << "a contour around the gap: bone joins";
    EXPECT_FLOAT_EQ(depth_mm[2], -half_a_diagonal_mm);
    EXPECT_GT(depth_mm[0], half_a_diagonal_mm);
}

}  // namespace
}  // namespace osteomill::contour_depth_test
