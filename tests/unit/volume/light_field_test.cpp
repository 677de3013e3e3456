#include "render_client/volume/passes/light_field.h"

#include <gtest/gtest.h>

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
                            ASSERT_EQ(field.at(x, y)[channel], plain.at(x, y)[channel]) << x << ' ' << y;
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

}  // namespace
}  // namespace osteomill::light_field_test
