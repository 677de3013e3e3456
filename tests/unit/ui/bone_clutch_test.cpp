#include "render_client/ui/view/bone_clutch.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace osteomill {
namespace {

const glm::ivec2 size_px(800, 600);
const ToolPose tool{{3.0, -4.0, 12.0}, glm::normalize(glm::dvec3(0.2, -0.3, 0.9))};

TEST(BoneClutch, LeavesTheToolWhereItWasUntilTheBoneIsMoved) {
    const Camera camera = camera_on({1.0, 2.0, 3.0}, 20.0);
    BoneClutch clutch;
    clutch.hold(camera, tool);
    EXPECT_EQ(clutch.pose(camera).position_mm, tool.position_mm);
    EXPECT_EQ(clutch.pose(camera).spindle_axis, tool.spindle_axis);
}

TEST(BoneClutch, KeepsTheToolInThePictureWhateverTheBoneDoes) {
    const Camera before = camera_on({1.0, 2.0, 3.0}, 20.0);
    BoneClutch clutch;
    clutch.hold(before, tool);
    Camera camera = before;
    orbit(camera, 1.1, -0.4);
    pan(camera, {120.0, -35.0}, size_px);
    zoom(camera, 0.8);
    const ToolPose now = clutch.pose(camera);
    const glm::dvec2 seen = pixel_of(camera, now.position_mm, size_px);
    const glm::dvec2 was = pixel_of(before, tool.position_mm, size_px);
    EXPECT_NEAR(seen.x, was.x, 1e-6);
    EXPECT_NEAR(seen.y, was.y, 1e-6);
    EXPECT_NEAR(glm::distance(camera.eye_mm(), now.position_mm),
                glm::distance(before.eye_mm(), tool.position_mm), 1e-9);
    EXPECT_NEAR(glm::length(now.spindle_axis), 1.0, 1e-12);
    for (const auto& [axis, axis_before] :
         {std::pair(camera.right(), before.right()), {camera.up(), before.up()}})
        EXPECT_NEAR(glm::dot(now.spindle_axis, axis), glm::dot(tool.spindle_axis, axis_before), 1e-12);
}

TEST(BoneClutch, MovesTheToolAgainstABoneThatIsDraggedSideways) {
    const Camera before = camera_on(tool.position_mm, 20.0);
    BoneClutch clutch;
    clutch.hold(before, tool);
    Camera camera = before;
    pan(camera, {50.0, 0.0}, size_px);  // the bone goes right in the picture: the tool left over it
    const double moved_mm = 50.0 * mm_per_px_at(before, tool.position_mm, size_px);
    EXPECT_LT(glm::distance(clutch.pose(camera).position_mm, tool.position_mm - moved_mm * before.right()),
              1e-9);
    EXPECT_LT(glm::distance(clutch.pose(camera).spindle_axis, tool.spindle_axis), 1e-12);
}

}  // namespace
}  // namespace osteomill
