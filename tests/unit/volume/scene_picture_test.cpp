#include "render_client/volume/passes/scene_picture.h"

#include <array>
#include <cmath>
#include <optional>

#include "render_client/volume/camera.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/slice_renderer.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::scene_picture_test {
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
    tool.state.burr_position_mm = position_mm;
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

TEST(ForceArrow, BeginsAtTheBurrsSurfaceAndIsLongEnoughToBeSeen) {
    Camera camera = camera_on({0.0, 0.0, 0.0}, 50.0);
    const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 0.0, 1.0));
    ToolState tool;
    const auto length_mm = [&](double force_n) {
        tool.force_n = force_n * along;
        const auto arrow = force_arrow(tool, 1.5, camera, size_px);
        if (!arrow) return 0.0;
        EXPECT_NEAR(glm::distance(arrow->from_mm, 1.5 * along), 0.0, 1e-9);
        return glm::dot(arrow->head_mm - arrow->from_mm, along);
    };
    EXPECT_EQ(length_mm(0.01), 0.0) << "no arrow";
    EXPECT_NEAR(length_mm(100.0), 400.0, 1e-9) << "4 mm a newton";
    ASSERT_GT(length_mm(0.05), 0.0);
    const auto weak = force_arrow(tool, 1.5, camera, size_px);
    EXPECT_NEAR(
        glm::distance(pixel_of(camera, weak->from_mm, size_px), pixel_of(camera, weak->head_mm, size_px)),
        40.0, 8.0)
        << "as it is seen; perspective makes more of what comes nearer";
    tool.burr_position_mm = 2.0 * camera.eye_mm();
    EXPECT_EQ(length_mm(1.0), 0.0) << "behind the eye";
}

TEST_F(ScenePictureTest, ShowsTheBurrThroughAShankBeforeIt) {
    Camera camera = camera_on({0.0, 0.0, 3.2}, 15.0);
    camera.elevation_rad = 1.5;
    DrawnTool tool = burr_at({0.0, 0.0, 3.2});
    tool.state.spindle_axis = -camera.forward();
    const gl::Framebuffer plain(size_px);
    plain.bind();
    const std::array<float, 3> background{0.2f, 0.9f, 0.2f};  // steel is grey
    glClearColor(background[0], background[1], background[2], 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    ToolRenderer tool_renderer;
    TileMask covered(size_px);
    tool_renderer.draw(tool, camera, covered);
    const auto middle = [&] {
        const Picture drawn = plain.read_back();
        const auto* pixel = drawn.at(size_px.x / 2, size_px.y / 2);
        return std::array<int, 3>{pixel[0], pixel[1], pixel[2]};
    };
    const auto burr = middle();
    tool_renderer.draw_seen_through(tool, camera, size_px);
    const auto mixed = middle();
    EXPECT_NEAR(burr[1], burr[0], 30) << "the burr, not the green behind it";
    EXPECT_NE(mixed, burr) << "the shank is to be seen, a little";
    // A part of 0.22 of it.
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(mixed[i], burr[i], 0.22 * 255 + 1) << i;
}

TEST_F(ScenePictureTest, ShowsAHandpieceFromTheSideAndNoneThatPointsAtTheEye) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    DrawnTool tool = burr_at({0.0, 0.0, 3.2});
    tool.state.spindle_axis = {0.0, 0.0, 1.0};
    double opacity_before = 1.0;
    for (const double elevation_rad : {0.0, 0.4, 0.7, 0.85, 1.1, 1.5}) {
        Camera camera = camera_on({0.0, 0.0, 13.0}, 40.0);
        camera.elevation_rad = elevation_rad;
        ScenePicture scene(renderer, size_px);
        const Picture bone = scene.draw(&textures, nullptr, camera).read_back();
        tool.has_handpiece = false;
        const Picture without = scene.draw(&textures, &tool, camera).read_back();
        tool.has_handpiece = true;
        const Picture with = scene.draw(&textures, &tool, camera).read_back();
        const double opacity = handpiece_opacity(tool, camera);
        EXPECT_LE(opacity, opacity_before);
        opacity_before = opacity;
        EXPECT_EQ(with == without, opacity == 0.0) << elevation_rad;
        EXPECT_EQ(scene.draw(&textures, nullptr, camera).read_back(), bone)
            << "the next frame has it no more";
    }
    EXPECT_EQ(opacity_before, 0.0);
}

TEST_F(ScenePictureTest, ShowsAThingWithoutItsForceAndWithNothingSeenThrough) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    ScenePicture scene(renderer, size_px);
    Camera camera = camera_on({0.0, 0.0, 3.2}, 6.0);
    DrawnTool tool = burr_at({0.0, 0.0, 3.2});
    const auto drawn = [&](double elevation_rad, double force_n, bool is_only_a_thing) {
        camera.elevation_rad = elevation_rad;
        tool.state.force_n = {force_n, 0.0, 0.0};
        tool.is_only_a_thing = is_only_a_thing;
        return scene.draw(&textures, &tool, camera).read_back();
    };
    // From aside nothing is in the way of the burr.
    EXPECT_EQ(drawn(0.0, 5.0, true), drawn(0.0, 0.0, false));
    EXPECT_NE(drawn(0.0, 5.0, false), drawn(0.0, 0.0, false));
    // From above the shank is.
    EXPECT_NE(drawn(1.5, 0.0, true), drawn(1.5, 0.0, false));
}

TEST_F(ScenePictureTest, ChangesThePictureOfAShankOnlyWhereItHides) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    ToolRenderer tool_renderer;
    DrawnTool tool = burr_at({0.0, 0.0, 3.2});
    for (const double elevation_rad : {-0.2, 0.0, 0.2, 0.5, 0.9, 1.2, 1.5}) {
        Camera camera = camera_on({0.0, 0.0, 3.2}, 6.0);
        camera.elevation_rad = elevation_rad;
        ScenePicture scene(renderer, size_px);
        scene.draw(&textures, nullptr, camera);
        const Picture without = scene.draw(&textures, nullptr, camera).read_back();
        const Picture with = scene.draw(&textures, &tool, camera).read_back();
        // The next frame restores all that was drawn.
        EXPECT_EQ(scene.draw(&textures, nullptr, camera).read_back(), without) << elevation_rad;
        // From aside the second pass has nothing to draw.
        gl::Framebuffer plain(size_px);
        plain.bind();
        glClearColor(0.2f, 0.4f, 0.6f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        TileMask covered(size_px);
        tool_renderer.draw(tool, camera, covered);
        const Picture before = plain.read_back();
        tool_renderer.draw_seen_through(tool, camera, size_px);
        const bool is_seen_through = !(plain.read_back() == before);
        if (elevation_rad <= 0.2 || elevation_rad >= 1.2) {
            EXPECT_EQ(is_seen_through, elevation_rad > 1.0) << elevation_rad;
        }
    }
}

/// A hilly slab as wide as the grid, so that walls shade each other.
Bone hills() {
    return made_bone(grid, [](const glm::dvec3& p) {
        return 1.0 + 0.8 * std::sin(2.0 * p.x) * std::cos(1.7 * p.y) - p.z;
    });
}

/// Passes everything on and counts the pixels that were requested of it.
class CountingRenderer final : public BoneRenderer {
  public:
    void draw(const BoneTextures& bone, const Camera& camera, const glm::ivec2& size) override {
        std::array<GLint, 4> scissor{};
        glGetIntegerv(GL_SCISSOR_BOX, scissor.data());
        const bool whole = glIsEnabled(GL_SCISSOR_TEST) == GL_FALSE;
        pixels += whole ? size.x * size.y : scissor[2] * scissor[3];
        renderer_.draw(bone, camera, size);
    }
    std::int64_t pixels = 0;

  private:
    RaycastRenderer renderer_;
};

TEST_F(ScenePictureTest, RedrawsUnderAStillCameraWhatAFullDrawWouldShow) {
    Bone bone = hills();
    BoneTextures textures(bone, {});
    CountingRenderer renderer;
    ScenePicture kept(renderer, size_px);
    // From afar, aslant, and from so near that the bone reaches behind the eye.
    const std::array<Camera, 3> cameras{
        camera_on({0.0, 0.0, 0.0}, 5.0),
        Camera{.distance_mm = 14.0, .azimuth_rad = 2.0, .elevation_rad = 0.3, .near_mm = 0.1},
        Camera{.distance_mm = 3.0, .elevation_rad = 0.6, .near_mm = 0.1}};
    for (std::size_t view = 0; view < cameras.size(); ++view) {
        kept.draw(&textures, nullptr, cameras[view]);
        for (int carve = 0; carve < 5; ++carve) {
            const auto step = static_cast<double>(5 * view + static_cast<std::size_t>(carve));
            std::vector<BrickChange> changes;
            for (const double side : {-1.0, 1.0})  // two at once, far apart
                for (const BrickChange& change :
                     carve_sphere(bone, {side * 3.0, -2.5 + 0.3 * step, 1.6 + 0.1 * side}, 0.5))
                    changes.push_back(change);
            kept.mark_dirty(textures, textures.update(bone, changes));
            ScenePicture fresh(renderer, size_px);
            EXPECT_EQ(kept.draw(&textures, nullptr, cameras[view]).read_back(),
                      fresh.draw(&textures, nullptr, cameras[view]).read_back())
                << "view " << view << ", carve " << carve;
        }
    }
}

TEST_F(ScenePictureTest, RedrawsACoarserCopyAndAnAtlasAsExactly) {
    for (const TextureLimits& limits :
         {TextureLimits{.longest_edge_texels = 16}, TextureLimits{.layout = BoneLayout::atlas}}) {
        Bone bone = hills();
        BoneTextures textures(bone, {}, {}, limits);
        RaycastRenderer renderer;
        ScenePicture kept(renderer, size_px);
        const Camera camera = camera_on({0.0, 0.0, 0.0}, 5.0);
        kept.draw(&textures, nullptr, camera);
        for (int carve = 0; carve < 4; ++carve) {
            const auto changes = carve_sphere(bone, {-2.0 + carve, 1.3 - carve, 1.4}, 0.6);
            kept.mark_dirty(textures, textures.update(bone, changes));
            ScenePicture fresh(renderer, size_px);
            EXPECT_EQ(kept.draw(&textures, nullptr, camera).read_back(),
                      fresh.draw(&textures, nullptr, camera).read_back())
                << description(textures.plan()) << ", carve " << carve;
        }
    }
}

TEST_F(ScenePictureTest, RedrawsSlicesAndSurfaceVoxelsAsExactly) {
    for (const RendererChoice choice : {RendererChoice::raycast, RendererChoice::slices})
        for (const Shading shading : {Shading::gradient, Shading::surface_voxels}) {
            if (choice == RendererChoice::raycast && shading == Shading::gradient) continue;  // see above
            Bone bone = hills();
            BoneTextures textures(bone, {}, {.shading = shading});
            const auto renderer = make_renderer(choice);
            ScenePicture kept(*renderer, size_px);
            const Camera camera = camera_on({0.0, 0.0, 0.0}, 5.0);
            kept.draw(&textures, nullptr, camera);
            for (int carve = 0; carve < 3; ++carve) {
                const auto changes = carve_sphere(bone, {-2.0 + carve, 1.3 - carve, 1.4}, 0.6);
                kept.mark_dirty(textures, textures.update(bone, changes));
                const BoneTextures uploaded(bone, {}, {.shading = shading});
                ScenePicture fresh(*renderer, size_px);
                const Picture redrawn = kept.draw(&textures, nullptr, camera).read_back();
                EXPECT_EQ(redrawn, fresh.draw(&textures, nullptr, camera).read_back())
                    << static_cast<int>(choice) << ", carve " << carve;
                ScenePicture again(*renderer, size_px);
                EXPECT_EQ(redrawn, again.draw(&uploaded, nullptr, camera).read_back())
                    << "textures made anew, carve " << carve;
            }
        }
}

TEST_F(ScenePictureTest, DrawsSeparateCarvesAndNotWhatLiesBetween) {
    const Grid long_grid{.size_voxels = {480, 32, 32}, .origin_mm = {-23.95, -1.55, -1.55}};
    Bone bone = made_bone(long_grid, [](const glm::dvec3& p) { return -p.z; });
    BoneTextures textures(bone, {});
    CountingRenderer renderer;
    ScenePicture picture(renderer, size_px);
    const Camera camera{.distance_mm = 50.0, .elevation_rad = 1.0};
    picture.draw(&textures, nullptr, camera);
    const std::int64_t whole = renderer.pixels;
    std::vector<BrickChange> changes;
    for (const double x : {-21.0, 21.0})
        for (const BrickChange& change : carve_sphere(bone, {x, 0.0, 0.0}, 0.4)) changes.push_back(change);
    picture.mark_dirty(textures, textures.update(bone, changes));
    renderer.pixels = 0;
    picture.draw(&textures, nullptr, camera);
    EXPECT_GT(renderer.pixels, 0);
    EXPECT_LT(renderer.pixels, whole / 5);  // their union is as wide as the picture
    renderer.pixels = 0;
    picture.draw(&textures, nullptr, camera);
    EXPECT_EQ(renderer.pixels, 0) << "nothing changed";
}

TEST_F(ScenePictureTest, RestoresWhatToolAndOverlayCovered) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    ScenePicture kept(renderer, size_px);
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    for (const double x : {-3.0, -2.6, 3.0, 40.0}) {
        DrawnTool tool = burr_at({x, -1.0, 2.9});
        tool.state.spindle_axis = glm::normalize(glm::dvec3(0.5, 0.1, 1.0));
        tool.state.force_n = {0.3, -0.4, 0.2 * x};
        tool.hand_target_mm = glm::dvec3(x, 0.0, 3.4);
        ScenePicture fresh(renderer, size_px);
        EXPECT_EQ(kept.draw(&textures, &tool, camera).read_back(),
                  fresh.draw(&textures, &tool, camera).read_back())
            << x;
        // An overlay that is only there until the next frame.
        const PixelBox box{{static_cast<int>(10.0 + std::abs(x)), 20}, {50, 33}};
        kept.draw(&textures, &tool, camera);
        glEnable(GL_SCISSOR_TEST);
        glScissor(box.first.x, box.first.y, box.size.x, box.size.y);
        glClearColor(1.0f, 0.0f, 1.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_SCISSOR_TEST);
        kept.cover(std::array{box});
    }
}

TEST_F(ScenePictureTest, ShowsHazeWithNothingSolidInIt) {
    const ShadingSettings haze{.transfer = TransferFunction{.name = "haze",
                                                            .mode = TransferMode::translucent,
                                                            .points = {{1.0, {255, 255, 255}, 0.3}}}};
    const BoneTextures textures(ball(), {}, haze);
    for (const RendererChoice choice : {RendererChoice::raycast, RendererChoice::slices}) {
        const auto renderer = make_renderer(choice);
        ScenePicture picture(*renderer, size_px);
        const Picture drawn = picture.draw(&textures, nullptr, camera_on({0.0, 0.0, 0.0}, 6.0)).read_back();
        EXPECT_GT(drawn.at(120, 90)[0], drawn.at(2, 90)[0] + 40) << static_cast<int>(choice);
    }
}

// Each program of a renderer that went may leave its name to one of the next.
TEST_F(ScenePictureTest, IsTheSameOfEachRendererInTurn) {
    const BoneTextures textures(ball(), {});
    std::optional<Picture> first;
    for (int turn = 0; turn < 6; ++turn) {
        SliceRenderer renderer;
        const Picture drawn = ScenePicture(renderer, size_px)
                                  .draw(&textures, nullptr, camera_on({0.0, 0.0, 0.0}, 6.0))
                                  .read_back();
        if (!first) first = drawn;
        EXPECT_GT(drawn.at(120, 90)[0], drawn.at(2, 90)[0] + 40) << turn;
        EXPECT_EQ(drawn, *first) << turn;
    }
}

TEST_F(ScenePictureTest, ShowsBoneAgainAfterAPictureWithoutIt) {
    const BoneTextures textures(ball(), {});
    RaycastRenderer renderer;
    ScenePicture picture(renderer, size_px);
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    const Picture before = picture.draw(&textures, nullptr, camera).read_back();
    picture.draw(nullptr, nullptr, camera);
    EXPECT_EQ(picture.draw(&textures, nullptr, camera).read_back(), before);
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
}  // namespace osteomill::scene_picture_test
