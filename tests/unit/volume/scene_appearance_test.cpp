#include "render_client/volume/scene_appearance.h"

#include <cmath>
#include <memory>

#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/scene_picture.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::scene_appearance_test {
namespace {

using SceneAppearanceTest = OffscreenTest;

const glm::ivec2 size_px(240, 180);
const glm::ivec2 middle = size_px / 2;
const Grid grid{.size_voxels = {96, 96, 80}, .origin_mm = {-4.75, -4.75, -3.95}};

/// A ball of radius 3 mm, red inside 2 mm, green outside.
Bone peach() {
    return made_bone(
        grid, [](const glm::dvec3& p) { return 3.0 - glm::length(p); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(glm::length(p) < 2.0 ? 1 : 2); });
}
const std::array<TissueColour, 2> colours{{{1, {230, 20, 20}}, {2, {20, 230, 20}}}};

/// Along the camera's axis.
double distance_of(const Camera& camera, float window_depth) {
    const glm::dmat4 projection = camera.projection(size_px);
    return projection[3][2] / (2.0 * static_cast<double>(window_depth) - 1.0 + projection[2][2]);
}

TEST_F(SceneAppearanceTest, CutShowsTheTissuesInsideAsAFlatFaceWhereTheCutIs) {
    const BoneTextures textures(peach(), colours);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    camera.azimuth_rad = camera.elevation_rad = 0.0;
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    const Picture whole = picture.draw(&textures, nullptr, camera).read_back();
    EXPECT_GT(whole.at(middle.x, middle.y)[1], 2 * whole.at(middle.x, middle.y)[0]);

    picture.set_appearance({.cuts = {{{0.0, -1.0, 0.0}, 0.5}}});  // all in front of y = -0.5 is gone
    const gl::Framebuffer& cut = picture.draw(&textures, nullptr, camera);
    const Picture inside = cut.read_back();
    EXPECT_GT(inside.at(middle.x, middle.y)[0], 2 * inside.at(middle.x, middle.y)[1]) << "the red core";
    const int shell_px = static_cast<int>(2.5 / mm_per_px_at(camera, {0.0, 0.0, 0.0}, size_px));
    const auto* shell = inside.at(middle.x + shell_px, middle.y);
    EXPECT_GT(shell[1], 2 * shell[0]) << "the green shell round it";
    for (const int aside : {0, 12, -20})
        EXPECT_NEAR(distance_of(camera, cut.depth_at({middle.x + aside, middle.y})), camera.distance_mm - 0.5,
                    0.01);
    // A flat face has one colour under a lamp that is far away.
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(inside.at(middle.x + 8, middle.y + 5)[channel], inside.at(middle.x, middle.y)[channel],
                    2);

    picture.set_appearance({});
    EXPECT_EQ(picture.draw(&textures, nullptr, camera).read_back(), whole) << "cuts are for the eye only";
}

// HU rise by 100 a mm to the patient's left, on a grid of its own.
TEST_F(SceneAppearanceTest, CutShowsTheCtWhereThatIsWanted) {
    const BoneTextures textures(peach(), colours);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    camera.azimuth_rad = camera.elevation_rad = 0.0;
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    const SceneAppearance plain{.cuts = {{{0.0, -1.0, 0.0}, 0.5}}};
    picture.set_appearance(plain);
    const Picture coloured = picture.draw(&textures, nullptr, camera).read_back();

    CtVolume ct{.grid = {.size_voxels = {41, 31, 31}, .spacing_mm = 0.5, .origin_mm = {-10.0, -7.0, -7.5}},
                .hu = {}};
    for (int place = 0; place < 41 * 31 * 31; ++place)
        ct.hu.push_back(static_cast<std::int16_t>(std::lround(100.0 * (-10.0 + 0.5 * (place % 41)))));
    SceneAppearance look = plain;
    look.ct = std::make_shared<const CtVolume>(ct);
    look.ct_window = {.level_hu = 0.0, .window_hu = 600.0};
    picture.set_appearance(look);
    const Picture grey = picture.draw(&textures, nullptr, camera).read_back();
    const double px_per_mm = 1.0 / mm_per_px_at(camera, {0.0, -0.5, 0.0}, size_px);
    for (const double left_mm : {-2.0, -1.0, 0.0, 0.7, 2.0}) {
        const auto* pixel = grey.at(middle.x + static_cast<int>(std::lround(left_mm * px_per_mm)), middle.y);
        const double wanted = 127.5 + 255.0 * 100.0 * left_mm / 600.0;
        for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(pixel[channel], wanted, 4.0) << left_mm;
    }
    // Another window is another grey.
    look.ct_window.window_hu = 2000.0;
    picture.set_appearance(look);
    const Picture flat = picture.draw(&textures, nullptr, camera).read_back();
    const auto* flatter = flat.at(middle.x + static_cast<int>(2.0 * px_per_mm), middle.y);
    EXPECT_NEAR(flatter[0], 127.5 + 255.0 * 200.0 / 2000.0, 4.0);
    picture.set_appearance(plain);
    EXPECT_EQ(picture.draw(&textures, nullptr, camera).read_back(), coloured);
}

TEST_F(SceneAppearanceTest, SeveralCutsLeaveWhatNoneTakesAway) {
    const BoneTextures textures(peach(), colours);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    camera.azimuth_rad = camera.elevation_rad = 0.0;
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    picture.set_appearance(
        {.cuts = {{{1.0, 0.0, 0.0}, 0.0}, {{0.0, 0.0, 1.0}, 0.0}, {{0.0, 1.0, 0.0}, -2.9}}});
    const gl::Framebuffer& drawn = picture.draw(&textures, nullptr, camera);
    // A splinter is left on the right hand of the patient, below, in front of y = -2.9.
    EXPECT_EQ(drawn.depth_at({middle.x + 15, middle.y - 15}), 1.0f);
    EXPECT_EQ(drawn.depth_at({middle.x - 15, middle.y + 15}), 1.0f);
    EXPECT_LT(drawn.depth_at({middle.x - 4, middle.y - 4}), 1.0f);
    EXPECT_EQ(drawn.depth_at({middle.x - 40, middle.y - 40}), 1.0f);
}

TEST_F(SceneAppearanceTest, BackgroundIsTheLooks) {
    const BoneTextures textures(peach(), colours);
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 9.0);
    const int dark = picture.draw(&textures, nullptr, camera).read_back().at(120, 2)[1];
    picture.set_appearance(
        {.cuts = {}, .background_low = glm::vec3(0.6f), .background_high = glm::vec3(0.8f)});
    const int light = picture.draw(&textures, nullptr, camera).read_back().at(120, 2)[1];
    EXPECT_LT(dark, 110);
    EXPECT_GT(light, 190);
}

TEST_F(SceneAppearanceTest, WetBoneHasHighlightsWhereALampIsMirroredAndElsewhereIsAsItWas) {
    const Bone ball = made_bone(grid, [](const glm::dvec3& p) { return 3.0 - glm::length(p); });
    Camera camera = camera_on({0.0, 0.0, 0.0}, 4.0);
    for (const RendererChoice choice : {RendererChoice::raycast, RendererChoice::slices}) {
        const BoneTextures textures(ball, {});
        const auto renderer = make_renderer(choice);
        ScenePicture picture(*renderer, size_px);
        const Picture matt = picture.draw(&textures, nullptr, camera).read_back();
        picture.set_appearance({.specular = 0.5f});
        const Picture wet = picture.draw(&textures, nullptr, camera).read_back();
        int brighter = 0, as_before = 0;
        for (std::size_t i = 0; i < wet.rgb.size(); i += 3) {
            ASSERT_GE(wet.rgb[i] + 1, matt.rgb[i]);
            brighter += wet.rgb[i] > matt.rgb[i] + 20 ? 1 : 0;
            as_before += wet.rgb[i] == matt.rgb[i] && matt.rgb[i] > 120 ? 1 : 0;
        }
        EXPECT_GT(brighter, 100);
        EXPECT_GT(as_before, 5 * brighter);
    }
    // The published surface is always matt.
    const BoneTextures published(ball, {}, {.shading = Shading::surface_voxels});
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    const Picture matt = picture.draw(&published, nullptr, camera).read_back();
    picture.set_appearance({.specular = 0.5f});
    EXPECT_EQ(picture.draw(&published, nullptr, camera).read_back(), matt);
}

}  // namespace
}  // namespace osteomill::scene_appearance_test
