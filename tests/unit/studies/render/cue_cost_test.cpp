#include "studies/render/cue_cost.h"

#include <stdexcept>

#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::study::cue_cost_test {
namespace {

using CueCostTest = OffscreenTest;

/// A ball with a burr's hole in it and a thin plate before it.
Bone ball_and_plate() {
    const Grid grid{.size_voxels = {96, 96, 80}, .origin_mm = {-4.75, -4.75, -3.95}};
    Bone bone = made_bone(grid, [](const glm::dvec3& p) {
        return std::max(3.0 - glm::length(p - glm::dvec3(0.6, 0.0, 0.0)),
                        0.25 - std::abs(p.x + 3.2 + 0.2 * p.y));
    });
    carve_sphere(bone, {1.0, -2.0, 2.6}, 1.5);
    return bone;
}

TEST_F(CueCostTest, SilhouettesComeThreeDecibelsNearerToFourByFourRaysAPixel) {
    const BoneTextures textures(ball_and_plate(), {});
    for (const double shown_mm : {6.0, 2.5}) {
        Camera camera = camera_on({0.0, 0.0, 0.0}, shown_mm);
        camera.elevation_rad = 0.75;
        const SilhouettePsnr psnr = silhouette_psnr(textures, camera, {240, 180});
        EXPECT_GT(psnr.pixels, 150U) << shown_mm;
        EXPECT_GT(psnr.with_db, psnr.without_db + 3.0) << shown_mm;
    }
}

TEST_F(CueCostTest, IsThatOfACueThatChangesThePicture) {
    const BoneTextures textures(ball_and_plate(), {});
    const Camera camera = camera_on({0.0, 0.0, 0.0}, 6.0);
    for (const std::string_view cue : cue_names) {
        const CueCost cost = cue_cost(cue, textures, camera, {120, 90}, 1);
        EXPECT_GT(cost.without_ms, 0.0);
        EXPECT_DOUBLE_EQ(cost.part_of_frame, cost.with_ms / cost.without_ms - 1.0);
        // Nothing stands behind this bone, and so near a handpiece would point at the eye.
        EXPECT_EQ(cost.changed_pixels > 0.0, cue != "thin bone" && cue != "handpiece") << cue;
    }
    EXPECT_GT(cue_cost("handpiece", textures, camera_on({0.0, 0.0, 0.0}, 80.0), {120, 90}, 1).changed_pixels,
              0.01);
    EXPECT_THROW(look_with("glitter", true), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study::cue_cost_test
