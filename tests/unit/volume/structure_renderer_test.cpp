#include "render_client/volume/structures/structure_renderer.h"

#include <array>

#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/scene_picture.h"
#include "studies/render/made_bone.h"
#include "tests/support/ball_structure.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::structure_renderer_test {
namespace {

using StructureRendererTest = OffscreenTest;

const glm::ivec2 size_px(240, 180);
const Grid grid{.size_voxels = {96, 96, 96}, .origin_mm = {-4.75, -4.75, -4.75}};

Bone ball() {
    return made_bone(grid, [](const glm::dvec3& p) { return 2.8 - glm::length(p); });
}

TEST_F(StructureRendererTest, ShowsASoftStructureBesideTheBoneAndCutsItAsTheBone) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    camera.elevation_rad = 0.0;
    const glm::dvec3 towards_eye = -camera.forward();
    const auto middle = [&](const Picture& drawn) {
        const std::uint8_t* pixel = drawn.at(size_px.x / 2, size_px.y / 2);
        return std::array<int, 3>{pixel[0], pixel[1], pixel[2]};
    };
    const auto with_nerve = [&](const glm::dvec3& centre_mm, double opacity) {
        picture.forget_structures();
        picture.add_structure(surface_of(testing::ball_mask(grid, centre_mm, 0.9), {0.0f, 0.0f, 1.0f}),
                              opacity);
        return middle(picture.draw(&textures, nullptr, camera).read_back());
    };
    const auto bone = middle(picture.draw(&textures, nullptr, camera).read_back());
    EXPECT_EQ(with_nerve(-3.75 * towards_eye, 1.0), bone) << "behind the bone";
    const auto solid = with_nerve(3.75 * towards_eye, 1.0);
    EXPECT_LT(solid[0], 30) << "blue";
    EXPECT_GT(solid[2], 80);
    const auto half = with_nerve(3.75 * towards_eye, 0.5);
    EXPECT_NEAR(half[0], 0.5 * (solid[0] + bone[0]), 2.0);
    EXPECT_NEAR(half[2], 0.5 * (solid[2] + bone[2]), 2.0);
    EXPECT_EQ(with_nerve(3.75 * towards_eye, 0.0), bone);
    with_nerve(3.75 * towards_eye, 1.0);
    picture.set_appearance({.cuts = {{.normal = towards_eye, .offset_mm = 2.81}}});
    const auto cut_away = middle(picture.draw(&textures, nullptr, camera).read_back());
    // Behind a cut a driver may round a ray's first step to another side.
    for (std::size_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(cut_away[channel], bone[channel], 1) << "cut away";
    picture.set_appearance({});
    picture.show_structure(0, false);
    EXPECT_EQ(middle(picture.draw(&textures, nullptr, camera).read_back()), bone) << "hidden";
    picture.show_structure(0, true);
    EXPECT_EQ(middle(picture.draw(&textures, nullptr, camera).read_back()), solid);
    picture.forget_structures();
    EXPECT_EQ(middle(picture.draw(&textures, nullptr, camera).read_back()), bone);
}

}  // namespace
}  // namespace osteomill::structure_renderer_test
