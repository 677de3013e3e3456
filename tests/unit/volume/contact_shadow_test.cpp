#include "render_client/volume/passes/contact_shadow.h"

#include "render_client/volume/passes/raycast_renderer.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::contact_shadow_test {
namespace {

/// A flat bone seen from above; its upper side is z = 0.
class ContactShadowTest : public OffscreenTest {
  protected:
    void SetUp() override {
        OffscreenTest::SetUp();
        if (IsSkipped()) return;
        camera_ = camera_on({0.0, 0.0, 0.0}, 12.0);
        camera_.azimuth_rad = 0.0;
        camera_.elevation_rad = 1.2;
        const Grid grid{.size_voxels = {200, 200, 32}, .origin_mm = {-9.95, -9.95, -2.95}};
        textures_.emplace(made_bone(grid, [](const glm::dvec3& p) { return -p.z; }),
                          std::span<TissueColour>());
    }

    Picture with_burr_at(double height_mm) {
        RaycastRenderer renderer;
        const ContactShadow shadow;
        const gl::Framebuffer bone(size_px_), picture(size_px_);
        bone.bind();
        renderer.draw(*textures_, camera_, size_px_);
        bone.copy_to(picture, {{0, 0}, size_px_});
        picture.bind();
        TileMask covered(size_px_);
        if (height_mm > 0.0)
            shadow.draw(bone, {0.0, 0.0, height_mm}, radius_mm_, {0.0, 0.0, 1.0}, camera_, covered);
        return picture.read_back();
    }
    /// 1 if the bone at a place on its upper side is as bright as without a burr.
    double light_at(const Picture& shadowed, const Picture& bare, const glm::dvec2& place_mm) {
        const glm::ivec2 pixel(pixel_of(camera_, {place_mm, 0.0}, size_px_));
        return static_cast<double>(shadowed.at(pixel.x, pixel.y)[1]) / bare.at(pixel.x, pixel.y)[1];
    }

    const glm::ivec2 size_px_{300, 240};
    const double radius_mm_ = 1.0;
    Camera camera_;
    std::optional<BoneTextures> textures_;
};

TEST_F(ContactShadowTest, DarkensUnderTheBurrTheMoreTheCloserItIs) {
    const Picture bare = with_burr_at(0.0);
    const double touching = light_at(with_burr_at(1.0), bare, {0.0, 0.0});
    const double near = light_at(with_burr_at(2.0), bare, {0.0, 0.0});
    const double far = light_at(with_burr_at(6.0), bare, {0.0, 0.0});
    EXPECT_LT(touching, 0.6);
    EXPECT_LT(touching, near - 0.1);
    EXPECT_LT(near, far);
    EXPECT_GT(far, 0.95);
}

// The key light comes from (-0.4364, -0.5455, 0.7155): the shadow of a ball at height h falls at h times
// (0.61, 0.7624).
TEST_F(ContactShadowTest, MovesAwayFromTheBurrAsTheBurrLeavesTheBone) {
    const Picture bare = with_burr_at(0.0);
    for (const double height_mm : {1.8, 2.6}) {
        const Picture picture = with_burr_at(height_mm);
        const glm::dvec2 foot = height_mm * glm::dvec2(0.61, 0.7624);
        EXPECT_LT(light_at(picture, bare, foot), 0.8) << height_mm;
        EXPECT_GT(light_at(picture, bare, -foot), 0.85) << height_mm;
    }
}

TEST_F(ContactShadowTest, LeavesBoneFarFromTheBurrAndTheBackgroundAlone) {
    const Picture bare = with_burr_at(0.0), picture = with_burr_at(1.0);
    EXPECT_EQ(light_at(picture, bare, {-9.0, -7.0}), 1.0);
    EXPECT_EQ(picture.at(2, 2)[0], bare.at(2, 2)[0]);
}

}  // namespace
}  // namespace osteomill::contact_shadow_test
