#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "render_client/volume/passes/slice_renderer.h"

namespace osteomill::view_slices_test {
namespace {

const glm::dvec3 low(0.0), high(4.0, 6.0, 8.0);

/// Volume of all slices: their area times the spacing.
double volume(const std::vector<glm::vec3>& triangles, double spacing) {
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
        area += 0.5 * static_cast<double>(glm::length(
                          glm::cross(triangles[i + 1] - triangles[i], triangles[i + 2] - triangles[i])));
    return area * spacing;
}

TEST(ViewSlices, FillTheBoxFromAnyDirection) {
    for (const glm::dvec3 direction :
         {glm::dvec3(1, 0, 0), glm::dvec3(-0.3, 0.5, 0.9), glm::dvec3(1, 1, 1)}) {
        const glm::dvec3 forward = glm::normalize(direction);
        const glm::dvec3 eye = 0.5 * (low + high) - 20.0123 * forward;
        EXPECT_NEAR(volume(view_slices(low, high, eye, forward, 0.05), 0.05), 4.0 * 6.0 * 8.0, 2.5);
    }
}

TEST(ViewSlices, StandAtWholeMultiplesOfTheSpacingFrontToBack) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(0.2, -0.7, 0.4));
    const glm::dvec3 eye = -10.0 * forward;
    double deepest = 0.0;
    for (const glm::vec3& corner : view_slices(low, high, eye, forward, 0.5)) {
        const double depth = glm::dot(glm::dvec3(corner) - eye, forward);
        EXPECT_NEAR(depth / 0.5, std::round(depth / 0.5), 1e-5);
        EXPECT_GT(depth, deepest - 1e-5);
        deepest = std::max(deepest, depth);
    }
    EXPECT_GT(deepest, 10.0);
}

TEST(ViewSlices, LeaveOutWhatIsBehindTheEye) {
    const glm::dvec3 eye(2.0, 3.0, 4.0);
    EXPECT_NEAR(volume(view_slices(low, high, eye, {0.0, 0.0, 1.0}, 0.1), 0.1), 4.0 * 6.0 * 4.0, 3.0);
    EXPECT_TRUE(view_slices(low, high, {2.0, 3.0, 20.0}, {0.0, 0.0, 1.0}, 0.1).empty());
}

TEST(ViewSlices, RefuseASpacingThatIsNotPositive) {
    EXPECT_THROW(view_slices(low, high, {}, {0.0, 0.0, 1.0}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::view_slices_test
