#include "render_client/volume/camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace osteomill::camera_test {
namespace {

const glm::ivec2 size_px(800, 600);

/// Pixel of a point by way of OpenGL's matrices, y down.
glm::dvec2 pixel_by_matrices(const Camera& camera, const glm::dvec3& position_mm) {
    const glm::dvec4 clip = camera.projection(size_px) * camera.view() * glm::dvec4(position_mm, 1.0);
    return {(0.5 + 0.5 * clip.x / clip.w) * size_px.x, (0.5 - 0.5 * clip.y / clip.w) * size_px.y};
}

TEST(Camera, StandsInFrontOfThePatientAndKeepsUpUpright) {
    Camera camera{.target_mm = {1.0, 2.0, 3.0}, .distance_mm = 50.0, .elevation_rad = 0.0};
    EXPECT_NEAR(glm::distance(camera.eye_mm(), glm::dvec3(1.0, -48.0, 3.0)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(camera.right(), glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-9);
    camera.elevation_rad = 0.7;
    camera.azimuth_rad = 2.0;
    EXPECT_GT(camera.up().z, 0.0);
    EXPECT_GT(camera.eye_mm().z, 3.0);
}

TEST(Camera, SeesAPointAtThePixelOfItsMatrices) {
    const Camera camera = camera_on({5.0, -3.0, 2.0}, 30.0);
    for (const glm::dvec3 point : {glm::dvec3(5, -3, 2), glm::dvec3(9, -8, 4), glm::dvec3(-6, 2, -3)})
        EXPECT_NEAR(glm::distance(pixel_of(camera, point, size_px), pixel_by_matrices(camera, point)), 0.0,
                    1e-6);
}

TEST(Camera, PansSoThatTheTargetFollowsThePointer) {
    Camera camera = camera_on({5.0, -3.0, 2.0}, 30.0);
    const glm::dvec3 seen_mm = camera.target_mm;
    const glm::dvec2 before = pixel_of(camera, seen_mm, size_px);
    pan(camera, {40.0, -25.0}, size_px);
    const glm::dvec2 after = pixel_of(camera, seen_mm, size_px);
    EXPECT_NEAR(glm::distance(after - before, glm::dvec2(40.0, -25.0)), 0.0, 1e-6);
}

TEST(Camera, NeverTipsOverAndNeverLeavesItsDepthRange) {
    Camera camera = camera_on({0.0, 0.0, 0.0}, 30.0);
    orbit(camera, 100.0, 100.0);
    EXPECT_LT(camera.elevation_rad, 1.5708);
    orbit(camera, 0.0, -100.0);
    EXPECT_GT(camera.elevation_rad, -1.5708);
    for (int notch = 0; notch < 200; ++notch) zoom(camera, 0.8);
    EXPECT_GT(camera.distance_mm, camera.near_mm);
    for (int notch = 0; notch < 400; ++notch) zoom(camera, 1.25);
    EXPECT_LT(camera.distance_mm, camera.far_mm);
}

}  // namespace
}  // namespace osteomill::camera_test
