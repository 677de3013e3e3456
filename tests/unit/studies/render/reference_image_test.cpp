#include "studies/render/reference_image.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/slice_renderer.h"
#include "studies/render/made_bone.h"
#include "studies/render/picture_difference.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::study {
namespace {

using ReferenceImageTest = OffscreenTest;

const glm::ivec2 size_px(128, 96);
const Grid grid{.size_voxels = {64, 64, 48}, .origin_mm = {-3.15, -3.15, -2.35}};
const std::array<TissueColour, 2> tissues{{{1, {230, 190, 150}}, {2, {200, 80, 70}}}};

/// Two tissues, a carved hollow, edges: the features that a picture of a small bone can get wrong.
Bone carved_bone() {
    Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return 2.2 - glm::length(p * glm::dvec3(0.8, 0.9, 1.1)); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 0.7 + 0.2 * p.x ? 1 : 2); });
    carve_sphere(bone, {0.3, -1.2, 1.9}, 1.0);
    return bone;
}

Camera view_of_bone() {
    Camera camera = camera_on({0.0, 0.0, 0.0}, 3.2);
    camera.elevation_rad = 0.9;
    return camera;
}

Picture drawn(BoneRenderer& renderer, const BoneTextures& textures, const Camera& camera) {
    const gl::Framebuffer framebuffer(size_px);
    framebuffer.bind();
    renderer.draw(textures, camera, size_px);
    return framebuffer.read_back();
}

TEST(ReferenceVolume, InterpolatesWhatIsLinearExactly) {
    // Rises from 0 to 1 over 25.5 voxels along x: 10 levels of a byte each.
    const Bone bone = made_bone(grid, [](const glm::dvec3& p) { return (p.x + 1.75) / 25.5 - 0.05; });
    const ReferenceVolume volume(bone, {}, {});
    const glm::dvec3 point(24.3, 20.1, 22.9);
    const double slope = 10.0 / 255.0;
    EXPECT_NEAR(volume.eight_corner_gradient_at(point).x, slope, 1e-12);
    EXPECT_NEAR(volume.fraction_at(point + glm::dvec3(0.5, 0.0, 0.0)) - volume.fraction_at(point),
                0.5 * slope, 1e-12);
}

TEST(ReferenceVolume, RefusesABoneWithoutBricks) {
    const Bone nothing = made_bone(grid, [](const glm::dvec3&) { return -1.0; });
    EXPECT_THROW(ReferenceVolume(nothing, {}, {}), std::runtime_error);
}

TEST(ReferenceImage, IsTheSameInOneThreadAndInSeveral) {
    const ReferenceVolume volume(carved_bone(), tissues, {});
    EXPECT_EQ(reference_image(volume, view_of_bone(), {40, 30}, {.threads = 1}),
              reference_image(volume, view_of_bone(), {40, 30}, {.threads = 3}));
}

struct HowDrawn {
    std::string name;
    bool slices;
    ShadingSettings look;
};

class RendererAccuracy : public OffscreenTest, public testing::WithParamInterface<HowDrawn> {};

TEST_P(RendererAccuracy, Reaches40Decibels) {
    const Bone bone = carved_bone();
    const BoneTextures textures(bone, tissues, GetParam().look);
    RaycastRenderer raycast;
    raycast.set_appearance({.smooth_silhouettes = false});  // a ray a pixel, as the reference
    SliceRenderer slices;
    BoneRenderer& renderer = GetParam().slices ? static_cast<BoneRenderer&>(slices) : raycast;
    const Picture reference =
        reference_image(ReferenceVolume(bone, tissues, GetParam().look), view_of_bone(), size_px);
    const Picture picture = drawn(renderer, textures, view_of_bone());
    RecordProperty("psnr_db", std::to_string(psnr_db(picture, reference)));
    EXPECT_GE(psnr_db(picture, reference), 40.0);
    EXPECT_GE(ssim(picture, reference), 0.98);
}

const TransferFunction glass{
    .name = "glass", .mode = TransferMode::translucent, .points = {{1.0, {240, 220, 190}, 0.6}}};

INSTANTIATE_TEST_SUITE_P(
    Combinations, RendererAccuracy,
    testing::Values(HowDrawn{"RaycastByGradient", false, {}},
                    HowDrawn{"RaycastOfSurfaceVoxels", false, {.shading = Shading::surface_voxels}},
                    HowDrawn{"SlicesByGradient", true, {}},
                    HowDrawn{"SlicesOfSurfaceVoxels", true, {.shading = Shading::surface_voxels}},
                    HowDrawn{"RaycastThroughGlass", false, {.transfer = glass}},
                    HowDrawn{"SlicesThroughGlass", true, {.transfer = glass}}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace osteomill::study
