#include "render_client/volume/surface_points.h"

#include <gtest/gtest.h>

#include <random>

#include "studies/render/made_bone.h"

namespace osteomill {
namespace {

const glm::dvec3 centre_mm(10.0, -4.0, 20.0);
constexpr double radius_mm = 5.0;
const glm::ivec2 size_px(400, 300);

Bone ball() {
    return made_bone({.size_voxels = {60, 60, 60}, .spacing_mm = 0.2, .origin_mm = centre_mm - 5.9},
                     [](const glm::dvec3& p) { return radius_mm - glm::distance(p, centre_mm); });
}

TEST(SurfacePick, FindsThePointThatIsSeenAtAPixelAndItsNormal) {
    const Bone bone = ball();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int found = 0;
    for (int i = 0; i < 200; ++i) {
        Camera camera = camera_on(centre_mm, 8.0);
        orbit(camera, 3.0 * unit(random), 1.5 * unit(random));
        const glm::dvec2 pixel(200.0 + 120.0 * unit(random), 150.0 + 120.0 * unit(random));
        const auto point = pick_surface(bone, camera, pixel, size_px, {});
        // A ray and a sphere, in closed form.
        const glm::dvec3 direction = direction_through(camera, pixel, size_px);
        const glm::dvec3 to_centre = centre_mm - camera.eye_mm();
        const double along = glm::dot(to_centre, direction);
        const double off = glm::length(to_centre - along * direction);
        if (off > radius_mm + 0.3) {
            EXPECT_FALSE(point);
        }
        if (off > radius_mm - 0.5) continue;
        ASSERT_TRUE(point);
        ++found;
        const glm::dvec3 met =
            camera.eye_mm() + (along - std::sqrt(radius_mm * radius_mm - off * off)) * direction;
        EXPECT_LT(glm::distance(point->position_mm, met), 0.7);
        EXPECT_NEAR(glm::distance(point->position_mm, centre_mm), radius_mm, 0.25);
        EXPECT_GT(glm::dot(point->normal, glm::normalize(point->position_mm - centre_mm)), 0.97);
        EXPECT_LT(glm::distance(pixel_of(camera, point->position_mm, size_px), pixel), 0.1);
    }
    EXPECT_GT(found, 50);
}

TEST(SurfacePick, PassesOverWhatACutTakesAway) {
    const Bone bone = ball();
    const Camera camera = camera_on(centre_mm, 8.0);
    const glm::dvec2 middle(200.0, 150.0);
    const CutPlane cut{camera.forward() * -1.0, glm::dot(camera.forward() * -1.0, centre_mm)};
    const auto point = pick_surface(bone, camera, middle, size_px, std::span(&cut, 1));
    ASSERT_TRUE(point);
    EXPECT_LT(glm::distance(point->position_mm, centre_mm), 0.3);
}

TEST(SurfacePick, FindsNothingBesideTheBoneAndBehindTheEye) {
    const Bone bone = ball();
    Camera camera = camera_on(centre_mm, 8.0);
    EXPECT_FALSE(pick_surface(bone, camera, {2.0, 2.0}, size_px, {}));
    camera.target_mm = centre_mm + 50.0 * camera.forward();
    camera.distance_mm = 1.0;
    EXPECT_FALSE(pick_surface(bone, camera, {200.0, 150.0}, size_px, {}));
}

}  // namespace
}  // namespace osteomill
