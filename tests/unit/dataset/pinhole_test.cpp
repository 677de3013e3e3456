#include "render_client/dataset/pinhole.h"

#include <glm/gtc/quaternion.hpp>

namespace osteomill::pinhole_test {
namespace {

const Pinhole skewed{{640, 480}, {800.0, 700.0}, {300.0, 260.0}};

/// Projects by the header's formula.
glm::dvec2 projected(const Pinhole& pinhole, const Pose& pose, const glm::dvec3& point_mm) {
    const glm::dvec3 seen = glm::conjugate(pose.rotation) * (point_mm - pose.position_mm);
    return pinhole.focal_px * glm::dvec2(seen) / seen.z + pinhole.centre_px;
}

TEST(PinholeTest, IsDrawnByACameraThatSeesEveryPointAtItsPixel) {
    const glm::dvec3 place_mm(10.0, -60.0, 40.0);
    for (const glm::dvec3 up : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0.2, -0.4), glm::dvec3(0, 0, -1)}) {
        const Pose pose = looking_at(place_mm, {3.0, 2.0, 1.0}, up);
        const Camera camera = camera_of(skewed, pose, glm::dvec3(0.0), 20.0);
        EXPECT_NEAR(glm::distance(camera.eye_mm(), place_mm), 0.0, 1e-9);
        for (const glm::dvec3 point_mm : {glm::dvec3(0.0), glm::dvec3(9, -8, 7), glm::dvec3(-15, 3, -9)}) {
            // pixel_of counts from the picture's corner, a pinhole from the middle of a pixel.
            const glm::dvec2 drawn = pixel_of(camera, point_mm, skewed.size_px) - 0.5;
            EXPECT_NEAR(glm::distance(drawn, projected(skewed, pose, point_mm)), 0.0, 1e-8);
            const glm::dvec3 back = direction_through(camera, drawn + 0.5, skewed.size_px);
            EXPECT_NEAR(glm::distance(back, glm::normalize(point_mm - place_mm)), 0.0, 1e-9);
            const glm::dvec4 clip =
                camera.projection(skewed.size_px) * camera.view() * glm::dvec4(point_mm, 1.0);
            const glm::dvec2 in_picture =
                0.5 * (glm::dvec2(clip) / clip.w + 1.0) * glm::dvec2(skewed.size_px);
            EXPECT_NEAR(in_picture.x, drawn.x + 0.5, 1e-8);
            EXPECT_NEAR(skewed.size_px.y - in_picture.y, drawn.y + 0.5, 1e-8);
        }
    }
}

TEST(PinholeTest, LooksStraightDownWithWhatIsGivenAsUp) {
    const Pose pose = looking_at({0.0, 0.0, 50.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0});
    const Camera camera = camera_of(skewed, pose, glm::dvec3(0.0), 20.0);
    EXPECT_NEAR(glm::distance(camera.up(), glm::dvec3(0, 1, 0)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(camera.right(), glm::dvec3(1, 0, 0)), 0.0, 1e-9);
    EXPECT_TRUE(std::isfinite(looking_at({0, 0, 5}, {0, 0, 0}, {0, 0, 1}).rotation.w));
}

TEST(PinholeTest, TakesUpThePoseOfACamera) {
    Camera camera = camera_on({1.0, 2.0, 3.0}, 30.0);
    const Pinhole pinhole = pinhole_of({320, 240}, camera.field_of_view_rad);
    const Camera again = camera_of(pinhole, pose_of(camera), {1.0, 2.0, 3.0}, 30.0);
    EXPECT_NEAR(glm::distance(again.eye_mm(), camera.eye_mm()), 0.0, 1e-9);
    EXPECT_NEAR(again.azimuth_rad, camera.azimuth_rad, 1e-9);
    EXPECT_NEAR(again.elevation_rad, camera.elevation_rad, 1e-9);
    EXPECT_NEAR(again.roll_rad, 0.0, 1e-9);
    EXPECT_NEAR(again.field_of_view_rad, camera.field_of_view_rad, 1e-12);
    EXPECT_NEAR(again.middle_slope, 0.0, 1e-12);
    EXPECT_NEAR(again.middle_rise, 0.0, 1e-12);
}

TEST(PinholeTest, MovesACameraToWhereAnotherLooks) {
    Camera theirs = camera_on({1.0, 2.0, 3.0}, 30.0);
    orbit(theirs, 0.4, -0.3);
    theirs.roll_rad = 0.2;
    theirs.field_of_view_rad = 0.3;
    const glm::dvec3 between_eyes_mm = theirs.eye_mm();
    theirs.eye_right_mm = -3.0;
    const Viewpoint view = viewpoint_of(theirs);
    EXPECT_NEAR(glm::distance(view.eye_mm, between_eyes_mm), 0.0, 1e-9);

    Camera mine = camera_on(glm::dvec3(0.0), 20.0);
    const Camera before = mine;
    look_through(mine, pinhole_of({960, 600}, view.field_of_view_rad), {view.eye_mm, view.rotation});
    EXPECT_NEAR(glm::distance(mine.eye_mm(), between_eyes_mm), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(mine.right(), theirs.right()), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(mine.forward(), theirs.forward()), 0.0, 1e-9);
    EXPECT_NEAR(mine.field_of_view_rad, 0.3, 1e-12);
    EXPECT_NEAR(mine.distance_mm, glm::dot(-between_eyes_mm, mine.forward()), 1e-9);
    EXPECT_EQ(mine.near_mm, before.near_mm);
}

TEST(Pinhole, LeavesThePivotAsDeepAsItWasForTheScaleOfThePicture) {
    const glm::ivec2 size_px(960, 720);
    const Pinhole pinhole{.size_px = size_px, .focal_px = {1000.0, 1000.0}, .centre_px = {479.5, 359.5}};
    Camera camera = camera_on({0.0, 0.0, 3.0}, 20.0);
    look_through(camera, pinhole, looking_at({0.0, -250.0, 3.0}, {20.0, 0.0, 3.0}, {0.0, 0.0, 1.0}));
    const double depth_mm = 250.0 * 250.0 / std::hypot(250.0, 20.0);
    EXPECT_NEAR(mm_per_px_at(camera, camera.target_mm, size_px), depth_mm / 1000.0, 1e-9);
    look_through(camera, pinhole, looking_at({0.0, 50.0, 3.0}, {0.0, 90.0, 3.0}, {0.0, 0.0, 1.0}));
    EXPECT_EQ(camera.distance_mm, camera.near_mm) << "it looks away from there";
}

}  // namespace
}  // namespace osteomill::pinhole_test
