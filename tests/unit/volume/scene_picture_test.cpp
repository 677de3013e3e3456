#include "render_client/volume/scene_picture.h"

#include "render_client/volume/raycast_renderer.h"
#include "tests/unit/volume/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill {
namespace {

using ScenePictureTest = OffscreenTest;

const glm::ivec2 size_px(240, 180);
const Grid grid{.size_voxels = {96, 96, 64}, .origin_mm = {-4.75, -4.75, -3.15}};

Bone ball() {
    return made_bone(grid, [](const glm::dvec3& p) { return 2.8 - glm::length(p); });
}

DrawnTool burr_at(const glm::dvec3& position_mm) {
    DrawnTool tool;
    tool.burr.diameter_mm = 1.0;
    tool.position_mm = position_mm;
    return tool;
}

TEST_F(ScenePictureTest, HidesTheToolBehindBoneAndShowsItInFront) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    camera.elevation_rad = -0.1;
    const Picture bone_alone = picture.draw(&textures, nullptr, camera).read_back();
    const auto middle = [&](const Picture& drawn) { return drawn.at(size_px.x / 2, size_px.y / 2)[2]; };

    const glm::dvec3 towards_eye = -camera.forward();
    DrawnTool behind = burr_at(-3.6 * towards_eye);
    DrawnTool in_front = burr_at(3.6 * towards_eye);
    EXPECT_EQ(middle(picture.draw(&textures, &behind, camera).read_back()), middle(bone_alone));
    EXPECT_NE(middle(picture.draw(&textures, &in_front, camera).read_back()), middle(bone_alone));
}

TEST_F(ScenePictureTest, RedrawsUnderAStillCameraWhatAFullDrawWouldShow) {
    Bone bone = ball();
    BoneTextures textures(bone, {});
    RaycastRenderer renderer;
    ScenePicture kept(renderer, size_px);
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 5.0);
    kept.draw(&textures, nullptr, camera);
    for (const double x : {-0.5, 0.0, 0.6}) {
        const auto dirty = carve_sphere(bone, {x, -1.0, 2.4}, 0.8);
        textures.update(bone, dirty);
        kept.mark_dirty(textures, dirty);
        ScenePicture fresh(renderer, size_px);
        EXPECT_EQ(kept.draw(&textures, nullptr, camera).read_back(),
                  fresh.draw(&textures, nullptr, camera).read_back());
    }
}

TEST_F(ScenePictureTest, SurvivesEverySizeDownToNothing) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    ScenePicture picture(renderer, {0, 0});
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 5.0);
    for (const glm::ivec2 size :
         {glm::ivec2(0, 0), glm::ivec2(1, 1), glm::ivec2(300, 1), glm::ivec2(33, 200)}) {
        picture.resize(size);
        EXPECT_EQ(picture.draw(&textures, nullptr, camera).read_back().size_px, glm::max(size, 1));
    }
}

TEST_F(ScenePictureTest, DrawsAPlainBackgroundWithoutBone) {
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    const Picture drawn = picture.draw(nullptr, nullptr, Camera{}).read_back();
    EXPECT_EQ(drawn.at(0, 0)[0], drawn.at(120, 90)[0]);
}

TEST(PixelsOfBox, GiveUpWhereTheBoxReachesBehindTheCamera) {
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 5.0);
    EXPECT_FALSE(pixels_of_box(camera, glm::dvec3(-100.0), glm::dvec3(100.0), size_px).has_value());
    const auto pixels = pixels_of_box(camera, glm::dvec3(-0.1), glm::dvec3(0.1), size_px);
    ASSERT_TRUE(pixels.has_value());
    EXPECT_LT(pixels->size.x, 20);
}

}  // namespace
}  // namespace osteomill
