#include "imaging/dicom/slice_stack.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "tests/support/message_of.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

std::vector<SlicePlacement> upright(int count) {
    std::vector<SlicePlacement> slices;
    for (int i = 0; i < count; ++i)
        slices.push_back({.name = "slice" + std::to_string(i),
                          .position_mm = {-10.0, -20.0, 1.5 * i},
                          .column_pitch_mm = 0.5,
                          .row_pitch_mm = 0.4,
                          .columns = 8,
                          .rows = 6});
    return slices;
}

std::string refusal(const std::vector<SlicePlacement>& slices) {
    return testing::message_of<std::invalid_argument>([&] { stack_slices(slices); });
}

std::string refusal_after(const std::function<void(std::vector<SlicePlacement>&)>& change) {
    std::vector<SlicePlacement> slices = upright(6);
    change(slices);
    return refusal(slices);
}

TEST(SliceGeometry, StacksSlicesInAnyOrderAlongTheirNormal) {
    std::vector<SlicePlacement> slices = upright(4);
    std::swap(slices[0], slices[3]);
    const SliceStack stack = stack_slices(slices);
    EXPECT_EQ(stack.order, (std::vector<std::size_t>{3, 1, 2, 0}));
    EXPECT_EQ(stack.origin_mm, glm::dvec3(-10.0, -20.0, 0.0));
    EXPECT_NEAR(glm::distance(stack.spacing_mm, glm::dvec3(0.5, 0.4, 1.5)), 0.0, 1e-12);
}

TEST(SliceGeometry, KeepsAnObliqueDirection) {
    std::vector<SlicePlacement> slices = upright(3);
    const double c = std::cos(0.3);
    const double s = std::sin(0.3);
    for (std::size_t i = 0; i < slices.size(); ++i) {
        slices[i].along_column = {0.0, c, s};
        slices[i].position_mm = 2.0 * static_cast<double>(i) * glm::dvec3(0.0, -s, c);
    }
    const SliceStack stack = stack_slices(slices);
    EXPECT_NEAR(glm::distance(stack.direction[2], glm::dvec3(0.0, -s, c)), 0.0, 1e-12);
    EXPECT_NEAR(stack.spacing_mm.z, 2.0, 1e-12);
}

TEST(SliceGeometry, ToleratesPositionsThatAScannerRounded) {
    std::vector<SlicePlacement> slices = upright(6);
    slices[2].position_mm.z += 0.015;
    EXPECT_EQ(refusal(slices), "");
}

TEST(SliceGeometry, RefusesASingleSlice) {
    EXPECT_THAT(refusal(upright(1)), HasSubstr("single slice"));
}

TEST(SliceGeometry, RefusesAMissingSliceAndNamesItsNeighbours) {
    const std::string reason = refusal_after([](auto& slices) { slices.erase(slices.begin() + 3); });
    EXPECT_THAT(reason, HasSubstr("1 missing slice"));
    EXPECT_THAT(reason, HasSubstr("between slice2 and slice4"));
}

TEST(SliceGeometry, RefusesUnevenSpacing) {
    EXPECT_THAT(refusal_after([](auto& slices) { slices[5].position_mm.z += 0.5; }),
                HasSubstr("unevenly spaced"));
}

TEST(SliceGeometry, RefusesTwoSlicesAtOnePlace) {
    EXPECT_THAT(refusal_after([](auto& slices) { slices[5].position_mm = slices[4].position_mm; }),
                HasSubstr("same position: slice4 and slice5"));
}

TEST(SliceGeometry, RefusesGantryTiltWithItsAngle) {
    const auto tilt = [](auto& slices) {
        for (auto& slice : slices) slice.position_mm.y += std::tan(0.2) * slice.position_mm.z;
    };
    EXPECT_THAT(refusal_after(tilt), HasSubstr("gantry tilt of 11.5 degrees"));
}

TEST(SliceGeometry, RefusesASliceThatIsShiftedSideways) {
    EXPECT_THAT(refusal_after([](auto& slices) { slices[3].position_mm.x += 1.0; }),
                HasSubstr("slice3 is shifted sideways by 1.0 mm"));
}

TEST(SliceGeometry, RefusesMixedSizesOrientationsAndSpacings) {
    EXPECT_THAT(refusal_after([](auto& slices) { slices[2].rows = 7; }), HasSubstr("mixed image sizes"));
    EXPECT_THAT(refusal_after([](auto& slices) {
                    slices[2].along_row = {0.0, 1.0, 0.0};
                    slices[2].along_column = {1.0, 0.0, 0.0};
                }),
                HasSubstr("mixed orientations"));
    EXPECT_THAT(refusal_after([](auto& slices) { slices[2].row_pitch_mm = 0.5; }),
                HasSubstr("mixed pixel spacings"));
}

TEST(SliceGeometry, RefusesSpacingsAndPositionsThatAreNoNumbers) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal_after([](auto& slices) { slices[1].row_pitch_mm = 0.0; }),
                HasSubstr("must be above 0"));
    EXPECT_THAT(refusal_after([&](auto& slices) { slices[1].column_pitch_mm = nan; }),
                HasSubstr("must be above 0"));
    EXPECT_THAT(refusal_after([&](auto& slices) { slices[1].position_mm.z = nan; }),
                HasSubstr("not a number"));
    EXPECT_THAT(refusal_after([&](auto& slices) { slices[1].along_row.x = nan; }),
                HasSubstr("not perpendicular"));
}

}  // namespace
}  // namespace osteomill
