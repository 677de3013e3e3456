#include "render_client/ui/view/inset_view.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "render_client/ui/panels/inset_panel.h"

namespace osteomill::inset_view_test {
namespace {

const glm::dvec3 burr_mm(3.0, -4.0, 5.0);

TEST(InsetView, LooksDownBesideTheHandpieceOntoTheBurr) {
    for (const glm::dvec3 along : {glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0),
                                   glm::dvec3(1, 0, 0), glm::dvec3(0.3, -0.9, -0.5)}) {
        const glm::dvec3 axis = glm::normalize(along);
        const Camera camera = endoscope_camera(burr_mm, axis);
        const glm::dvec3 from_burr_mm = camera.eye_mm() - burr_mm;
        EXPECT_NEAR(glm::dot(from_burr_mm, axis), 10.0, 1e-9);
        EXPECT_NEAR(glm::length(from_burr_mm - 10.0 * axis), 4.0, 1e-9);
        EXPECT_NEAR(glm::distance(camera.forward(), -glm::normalize(from_burr_mm)), 0.0, 1e-9);
        EXPECT_NEAR(glm::distance(pixel_of(camera, burr_mm, {200, 200}), glm::dvec2(100.0)), 0.0, 1e-6);
    }
}

TEST(InsetView, ShowsAnAxialSectionAsRadiologistsDo) {
    const Camera camera = axial_camera(burr_mm);
    const glm::ivec2 size_px(300, 300);
    EXPECT_NEAR(glm::distance(pixel_of(camera, burr_mm, size_px), glm::dvec2(150.0)), 0.0, 1e-6);
    // 20 mm wide: 15 pixels a mm. The front (-y) is above; left (+x) is at the left until it is mirrored.
    const glm::dvec2 left = pixel_of(camera, burr_mm + glm::dvec3(2.0, 0.0, 0.0), size_px);
    EXPECT_NEAR(glm::distance(left, glm::dvec2(120.0, 150.0)), 0.0, 1e-6);
    const glm::dvec2 front = pixel_of(camera, burr_mm + glm::dvec3(0.0, -2.0, 0.0), size_px);
    EXPECT_NEAR(glm::distance(front, glm::dvec2(150.0, 120.0)), 0.0, 1e-6);
    const CutPlane cut = axial_cut(burr_mm);
    EXPECT_LT(glm::dot(cut.normal, burr_mm - glm::dvec3(0.0, 0.0, 0.1)), cut.offset_mm);
    EXPECT_GT(glm::dot(cut.normal, burr_mm + glm::dvec3(0.0, 0.0, 0.1)), cut.offset_mm);
}

TEST(InsetPanel, IsNotWhereTheBurrIs) {
    const glm::vec2 picture(900.0f, 600.0f);
    EXPECT_EQ(inset_anchor({100.0, 500.0}, picture), Anchor::upper_left);
    EXPECT_EQ(inset_anchor({100.0, 100.0}, picture), Anchor::upper_right);
    EXPECT_EQ(inset_anchor({800.0, 100.0}, picture), Anchor::upper_left);
    EXPECT_EQ(inset_edge_px(picture), 180);
    EXPECT_EQ(inset_edge_px({1.0f, 1.0f}), 1);
}

}  // namespace
}  // namespace osteomill::inset_view_test
