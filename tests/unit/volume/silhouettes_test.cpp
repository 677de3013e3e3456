#include "render_client/volume/passes/silhouettes.h"

#include <cstdlib>
#include <vector>

#include "render_client/volume/passes/raycast_renderer.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::silhouettes_test {
namespace {

using SilhouettesTest = OffscreenTest;

const glm::ivec2 size_px(240, 180);
const Grid grid{.size_voxels = {96, 96, 80}, .origin_mm = {-4.75, -4.75, -3.95}};

Bone carved_ball() {
    Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 3.4 - glm::length(p); });
    carve_sphere(bone, {1.0, -2.0, 2.6}, 1.5);
    return bone;
}

Camera ball_camera() {
    Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    camera.elevation_rad = 0.75;
    return camera;
}

void draw(RaycastRenderer& renderer, const gl::Framebuffer& framebuffer, const BoneTextures& textures,
          const Camera& camera) {
    framebuffer.bind();
    renderer.draw(textures, camera, framebuffer.size_px());
}

TEST_F(SilhouettesTest, ChangeWhatIsBesideADepthDiscontinuityAndNothingElse) {
    const BoneTextures textures(carved_ball(), {});
    const gl::Framebuffer plain(size_px), smooth(size_px);
    RaycastRenderer plain_renderer, smooth_renderer;
    smooth_renderer.set_appearance({.smooth_silhouettes = true});
    draw(plain_renderer, plain, textures, ball_camera());
    draw(smooth_renderer, smooth, textures, ball_camera());
    const std::vector<float> depth = plain.read_depth();
    EXPECT_EQ(smooth.read_depth(), depth) << "what is drawn into the picture later is hidden where it was";
    const Picture before = plain.read_back(), after = smooth.read_back();
    const auto is_bone = [&](int x, int y) {
        return depth[static_cast<std::size_t>(y * size_px.x + x)] < 1.0f;
    };
    int changed_at_outline = 0, outline = 0;
    for (int y = 1; y < size_px.y - 1; ++y)
        for (int x = 1; x < size_px.x - 1; ++x) {
            const bool is_at_outline =
                is_bone(x - 1, y) != is_bone(x, y) || is_bone(x + 1, y) != is_bone(x, y) ||
                is_bone(x, y - 1) != is_bone(x, y) || is_bone(x, y + 1) != is_bone(x, y);
            const bool is_changed = !std::equal(before.at(x, y), before.at(x, y) + 3, after.at(x, y));
            outline += is_at_outline ? 1 : 0;
            changed_at_outline += is_at_outline && is_changed ? 1 : 0;
            if (!is_bone(x, y) && !is_at_outline) {
                EXPECT_FALSE(is_changed) << x << ", " << y;
            }
        }
    EXPECT_GT(outline, 300);
    // An outline runs through one of the two pixels beside it.
    EXPECT_GT(changed_at_outline, outline / 3);
    EXPECT_TRUE(std::equal(before.at(110, 100), before.at(110, 100) + 3, after.at(110, 100)));
}

TEST_F(SilhouettesTest, AreTheSameInPartsAsInTheWhole) {
    const BoneTextures textures(carved_ball(), {});
    const gl::Framebuffer whole(size_px), parts(size_px);
    RaycastRenderer renderer;
    renderer.set_appearance({.smooth_silhouettes = true});
    draw(renderer, whole, textures, ball_camera());
    const gl::Framebuffer coarse(size_px / 2);
    draw(renderer, coarse, textures, ball_camera());  // the renderer draws other sizes in between
    // The second kind cuts through the blocks that are searched for depth discontinuities.
    for (const glm::ivec2 part : {glm::ivec2(80, 48), glm::ivec2(61, 45)}) {
        parts.bind();
        glClear(GL_COLOR_BUFFER_BIT);
        glEnable(GL_SCISSOR_TEST);
        for (int y = 0; y < size_px.y; y += part.y)
            for (int x = 0; x < size_px.x; x += part.x) {
                glScissor(x, y, part.x, part.y);
                parts.bind();
                renderer.draw(textures, ball_camera(), size_px);
            }
        glDisable(GL_SCISSOR_TEST);
        EXPECT_EQ(parts.read_back(), whole.read_back()) << part.x;
        EXPECT_EQ(parts.read_depth(), whole.read_depth()) << part.x;
    }
}

TEST_F(SilhouettesTest, AreLeftAloneWhereOneSeesThroughBone) {
    const BoneTextures textures(carved_ball(), {}, {.transfer = transfer_presets()[1]});
    ASSERT_TRUE(textures.is_translucent());
    const gl::Framebuffer plain(size_px), smooth(size_px);
    RaycastRenderer plain_renderer, smooth_renderer;
    smooth_renderer.set_appearance({.smooth_silhouettes = true});
    draw(plain_renderer, plain, textures, ball_camera());
    draw(smooth_renderer, smooth, textures, ball_camera());
    EXPECT_EQ(smooth.read_back(), plain.read_back());
}

}  // namespace
}  // namespace osteomill::silhouettes_test
