#include "render_client/volume/passes/light_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/scene_picture.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::light_field_test {
namespace {

using LightFieldTest = OffscreenTest;

const Grid grid{.size_voxels = {32, 32, 32}, .origin_mm = {-1.55, -1.55, -1.55}};

TEST_F(LightFieldTest, IsRoundAsItIsShownAndGoesWithoutATrace) {
    const BoneTextures textures(made_bone(grid, [](const glm::dvec3& p) { return 1.0 - glm::length(p); }),
                                {});
    RaycastRenderer renderer;
    for (const auto& [size_px, aspect] :
         {std::pair{glm::ivec2(160, 100), 1.0}, std::pair{glm::ivec2(80, 100), 2.0},
          std::pair{glm::ivec2(160, 50), 0.5}}) {
        Camera camera = camera_on({0.0, 0.0, 0.0}, 2.0);
        camera.pixel_aspect = aspect;
        ScenePicture picture(renderer, size_px);
        picture.set_appearance({});
        const Picture plain = picture.draw(&textures, nullptr, camera).read_back();
        SceneAppearance look;
        look.light_field = true;
        picture.set_appearance(look);
        for (int frame = 0; frame < 3; ++frame) {  // it must not darken what it darkened
            const Picture field = picture.draw(&textures, nullptr, camera).read_back();
            for (int y = 0; y < size_px.y; ++y)
                for (int x = 0; x < size_px.x; ++x) {
                    const glm::dvec2 away(aspect * (x + 0.5 - 0.5 * size_px.x), y + 0.5 - 0.5 * size_px.y);
                    const double radius =
                        glm::length(away) / (0.5 * std::min(aspect * size_px.x, 1.0 * size_px.y));
                    for (int channel = 0; channel < 3; ++channel) {
                        if (radius < 0.94) {
                            const double light = 1.0 - 0.45 * radius * radius;
                            // The ball lies in the focus: its front is a millimetre nearer, its rim hardly
                            // deeper.
                            ASSERT_NEAR(field.at(x, y)[channel],
                                        std::pow(light, 1.0 / 2.2) * plain.at(x, y)[channel], 1.5)
                                << x << ' ' << y;
                        }
                        if (radius > 1.0) {
                            ASSERT_EQ(field.at(x, y)[channel], 0) << x << ' ' << y;
                        }
                    }
                }
        }
        picture.set_appearance({});
        EXPECT_EQ(picture.draw(&textures, nullptr, camera).read_back(), plain);
    }
}

TEST_F(LightFieldTest, FallsOffBehindTheFocusByTheSquareOfTheDistance) {
    // Two steps that face the eye: one in the focus, the other 1 mm deeper.
    const BoneTextures textures(
        made_bone(grid, [](const glm::dvec3& p) { return (p.x > 0.0 ? 0.0 : -1.0) - p.z; }), {});
    RaycastRenderer renderer;
    const glm::ivec2 size_px(120, 90);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 2.0);
    camera.elevation_rad = 1.57;
    ScenePicture picture(renderer, size_px);
    const Picture plain = picture.draw(&textures, nullptr, camera).read_back();
    picture.set_appearance({.light_field = true});
    const Picture field = picture.draw(&textures, nullptr, camera).read_back();
    const auto light_at = [&](double left_mm) {
        const double px_per_mm = 1.0 / mm_per_px_at(camera, {0.0, 0.0, 0.0}, size_px);
        const int x = 60 + static_cast<int>(std::lround(left_mm * px_per_mm)), y = 45;
        const double radius = std::abs(x + 0.5 - 60.0) / 45.0;
        const double seen = std::pow(1.0 * field.at(x, y)[0] / plain.at(x, y)[0], 2.2);
        return seen / (1.0 - 0.45 * radius * radius);
    };
    EXPECT_NEAR(light_at(0.6), 1.0, 0.03);
    EXPECT_NEAR(light_at(-0.6), std::pow(camera.distance_mm / (camera.distance_mm + 1.0), 2.0), 0.03);
}

}  // namespace
}  // namespace osteomill::light_field_test
