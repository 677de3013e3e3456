#include "render_client/volume/passes/raycast_renderer.h"

#include <cmath>
#include <cstdlib>

#include "render_client/volume/gl/framebuffer.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::raycast_renderer_test {
namespace {

using RaycastRendererTest = OffscreenTest;

const glm::ivec2 size_px(240, 180);
const Grid grid{.size_voxels = {96, 96, 80}, .origin_mm = {-4.75, -4.75, -3.95}};

Picture drawn(const BoneTextures& textures, const Camera& camera,
              EmptySpaceSkipping skipping = EmptySpaceSkipping::distance_map) {
    RaycastRenderer renderer({.skipping = skipping});
    const gl::Framebuffer framebuffer(size_px);
    framebuffer.bind();
    renderer.draw(textures, camera, size_px);
    return framebuffer.read_back();
}

double depth_of(const Camera& camera, float window_depth) {
    const glm::dmat4 projection = camera.projection(size_px);
    const double ndc = 2.0 * static_cast<double>(window_depth) - 1.0;
    return projection[3][2] / (-projection[2][2] - ndc) * -1.0;
}

Bone carved_ball() {
    Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 3.4 - glm::length(p); });
    carve_sphere(bone, {1.0, -2.0, 2.6}, 1.5);
    return bone;
}

/// Pixels that differ by more than one level of a channel.
int differing_pixels(const Picture& a, const Picture& b) {
    int count = 0;
    for (std::size_t pixel = 0; pixel < a.rgb.size(); pixel += 3)
        for (std::size_t channel = pixel; channel < pixel + 3; ++channel)
            if (std::abs(a.rgb[channel] - b.rgb[channel]) > 1) {
                ++count;
                break;
            }
    return count;
}

Camera ball_camera(double elevation_rad) {
    Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    camera.elevation_rad = elevation_rad;
    return camera;
}

TEST_F(RaycastRendererTest, DrawsTheSamePictureWithAndWithoutSkippingInBothLayouts) {
    for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas}) {
        const BoneTextures textures(carved_ball(), {}, {}, {.layout = layout});
        for (const double elevation : {0.75, 0.0, -0.6}) {
            const Camera camera = ball_camera(elevation);
            EXPECT_EQ(drawn(textures, camera), drawn(textures, camera, EmptySpaceSkipping::none));
        }
    }
}

// Texture coordinates are rounded differently: a grazing ray may just meet or just miss.
TEST_F(RaycastRendererTest, DrawsAnAtlasLikeADenseTexture) {
    const std::array<TissueColour, 2> tissues{{{1, {230, 20, 20}}, {2, {20, 230, 20}}}};
    Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return 3.4 - glm::length(p); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 0.53 ? 1 : 2); });
    carve_sphere(bone, {1.0, -2.0, 2.6}, 1.5);
    const BoneTextures dense(bone, tissues, {}, {.layout = BoneLayout::dense});
    const BoneTextures atlas(bone, tissues, {}, {.layout = BoneLayout::atlas});
    for (const double elevation : {0.75, 0.0, -0.6}) {
        const Camera camera = ball_camera(elevation);
        EXPECT_LE(differing_pixels(drawn(dense, camera), drawn(atlas, camera)), 4);
    }
}

TEST_F(RaycastRendererTest, DrawsTheSamePictureAfterUpdatesAsAfterAFullUploadInBothLayouts) {
    const Bone whole = made_bone(grid, [](const glm::dvec3& p) { return 3.4 - glm::length(p); });
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas}) {
        Bone bone = whole;
        BoneTextures updated(bone, {}, {}, {.layout = layout});
        const Picture before = drawn(updated, camera);
        std::vector<BrickChange> carved;
        for (double x = -1.0; x < 1.0; x += 0.25) {
            const auto changes = carve_sphere(bone, {x, -2.0, 2.6}, 1.2);
            updated.update(bone, changes);
            carved.insert(carved.end(), changes.begin(), changes.end());
        }
        const BoneTextures uploaded(bone, {}, {}, {.layout = layout});
        EXPECT_EQ(drawn(updated, camera), drawn(uploaded, camera));
        EXPECT_NE(drawn(updated, camera), before);
        // Undone: built while carved, the map of empty space spans the cut.
        BoneTextures refilled(bone, {}, {}, {.layout = layout});
        updated.update(whole, carved);
        refilled.update(whole, carved);
        EXPECT_EQ(drawn(updated, camera), before);
        EXPECT_EQ(drawn(refilled, camera), before);
    }
}

TEST_F(RaycastRendererTest, DrawsACoarserCopyAtTheSamePlaceAndCarvesIt) {
    const Bone whole = made_bone(grid, [](const glm::dvec3& p) { return 3.0 - glm::length(p); });
    Bone bone = whole;
    // All of the bone needs twice the budget, in either layout.
    const std::size_t dense_bytes = BoneTextures(whole, {}).plan().bytes;
    BoneTextures coarse(bone, {}, {}, {.budget_bytes = dense_bytes / 2});
    ASSERT_EQ(coarse.plan().coarsening, 2);
    Camera camera = ball_camera(1.4);
    const gl::Framebuffer framebuffer(size_px);
    RaycastRenderer renderer;
    const auto distance_mm = [&] {
        framebuffer.bind();
        renderer.draw(coarse, camera, size_px);
        return depth_of(camera, framebuffer.depth_at(size_px / 2));
    };
    EXPECT_NEAR(distance_mm(), camera.distance_mm - 3.0, grid.spacing_mm);
    coarse.update(bone, carve_sphere(bone, {0.0, 0.0, 3.0}, 1.0));
    EXPECT_GT(distance_mm(), camera.distance_mm - 2.3);
}

// The outline of a ball of radius r at distance d lies at angle asin(r / d) from the line to its centre.
TEST_F(RaycastRendererTest, OutlinesABallWithinHalfAVoxel) {
    const double radius_mm = 3.0;
    const Bone bone = made_bone(grid, [&](const glm::dvec3& p) { return radius_mm - glm::length(p); });
    const BoneTextures textures(bone, {});
    Camera camera = camera_on({0.0, 0.0, 0.0}, 4.2);
    RaycastRenderer renderer;
    const glm::ivec2 large_px(800, 600);
    const gl::Framebuffer framebuffer(large_px);
    framebuffer.bind();
    renderer.draw(textures, camera, large_px);
    int first = large_px.x, last = -1;
    for (int x = 0; x < large_px.x; ++x)
        if (framebuffer.depth_at({x, large_px.y / 2}) < 1.0f) {
            first = std::min(first, x);
            last = std::max(last, x);
        }
    const double half_angle = std::asin(radius_mm / camera.distance_mm);
    const double px_per_tangent = 0.5 * large_px.y / std::tan(0.5 * camera.field_of_view_rad);
    const double width_px = 2.0 * px_per_tangent * std::tan(half_angle);
    const double voxel_px = grid.spacing_mm / mm_per_px_at(camera, camera.target_mm, large_px);
    EXPECT_NEAR(last - first + 1, width_px, voxel_px);
}

TEST_F(RaycastRendererTest, WritesTheDepthOfTheSurface) {
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 3.0 - glm::length(p); });
    const BoneTextures textures(bone, {});
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    RaycastRenderer renderer;
    const gl::Framebuffer framebuffer(size_px);
    framebuffer.bind();
    renderer.draw(textures, camera, size_px);
    const float depth = framebuffer.depth_at(size_px / 2);
    EXPECT_NEAR(depth_of(camera, depth), camera.distance_mm - 3.0, 0.5 * grid.spacing_mm);
}

// A plane that runs through dozens of bricks, aslant to them, has one normal and so one colour.
TEST_F(RaycastRendererTest, ShowsNoSeamAtBrickBorders) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1, -0.2, 1.0));
    const Bone bone = made_bone(grid, [&](const glm::dvec3& p) { return 0.3 - glm::dot(p, normal); });
    const BoneTextures textures(bone, {});
    Camera camera = camera_on({0.0, 0.0, 0.0}, 2.0);
    camera.elevation_rad = 1.2;
    const Picture picture = drawn(textures, camera);
    int darkest = 255, lightest = 0;
    for (int y = 40; y < 140; ++y)
        for (int x = 60; x < 180; ++x) {
            darkest = std::min<int>(darkest, picture.at(x, y)[0]);
            lightest = std::max<int>(lightest, picture.at(x, y)[0]);
        }
    EXPECT_LE(lightest - darkest, 10);
    EXPECT_GT(darkest, 120);
}

TEST_F(RaycastRendererTest, ColoursCarvedWallsByTheTissueThatTheyCutThrough) {
    const std::array<TissueColour, 2> tissues{{{1, {230, 20, 20}}, {2, {20, 230, 20}}}};
    Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return 2.0 - p.z; },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 0.5 ? 1 : 2); });
    BoneTextures textures(bone, tissues);
    Camera camera = camera_on({0.0, 0.0, 1.0}, 4.0);
    camera.elevation_rad = 1.5;
    const glm::ivec2 middle = size_px / 2;
    const Picture before = drawn(textures, camera);
    EXPECT_GT(before.at(middle.x, middle.y)[0], 2 * before.at(middle.x, middle.y)[1]);
    textures.update(bone, carve_sphere(bone, {0.0, 0.0, 1.6}, 1.8));
    const Picture after = drawn(textures, camera);
    EXPECT_GT(after.at(middle.x, middle.y)[1], 2 * after.at(middle.x, middle.y)[0]);
}

}  // namespace
}  // namespace osteomill::raycast_renderer_test
