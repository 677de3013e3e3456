#include <cmath>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/shading_settings.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::bone_grain_test {
namespace {

using BoneGrainTest = OffscreenTest;

const glm::ivec2 size_px(160, 120);

TEST(BoneGrain, IsCoarseInTrabecularBoneFineInCorticalBoneAndHardlyInEnamel) {
    const glm::vec2 trabecular = grain_of_stiffness(0.1), cortical = grain_of_stiffness(1.0);
    const glm::vec2 enamel = grain_of_stiffness(2.5);
    EXPECT_GT(trabecular.y, 2.0f * trabecular.x);
    EXPECT_GT(cortical.x, cortical.y);
    EXPECT_LT(enamel.x + enamel.y, 0.2f * (cortical.x + cortical.y));
    for (double stiffness = 0.0; stiffness < 4.0; stiffness += 0.05) {
        const glm::vec2 grain = grain_of_stiffness(stiffness);
        EXPECT_GE(std::min(grain.x, grain.y), 0.0f) << stiffness;
        EXPECT_LT(grain.x + grain.y, 0.35f) << stiffness;
    }
}

/// A flat slab up to z = 0, homogeneous, in a grid that begins at that corner.
BoneTextures slab(const glm::dvec3& corner_mm, double relative_stiffness = 1.0) {
    const Grid grid{.size_voxels = {96, 96, 48}, .origin_mm = corner_mm};
    return {filled(BoneBuilder::homogeneous(grid, relative_stiffness, false), grid,
                   [&](const glm::ivec3& voxel) {
                       const double z = centre_of_voxel_mm(grid, voxel).z;
                       return VoxelValues{.fraction = fraction_of_depth(-z, grid.spacing_mm)};
                   }),
            {}};
}
const glm::dvec3 corner_mm(-4.75, -4.75, -3.95);

Camera from_above(double shown_mm) {
    Camera camera = camera_on({0.0, 0.0, 0.0}, shown_mm);
    camera.elevation_rad = 1.57;
    return camera;
}

Picture drawn(const BoneTextures& bone, const Camera& camera, bool grain,
              RendererChoice choice = RendererChoice::raycast) {
    const auto renderer = make_renderer(choice);
    renderer->set_appearance({.grain = grain});
    const gl::Framebuffer framebuffer(size_px);
    framebuffer.bind();
    renderer->draw(bone, camera, size_px);
    return framebuffer.read_back();
}

struct Levels {
    double mean = 0.0, deviation = 0.0;
};

/// Levels of green in the picture's middle.
Levels levels_of(const Picture& picture) {
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int y = 20; y < size_px.y - 20; ++y)
        for (int x = 20; x < size_px.x - 20; ++x, ++count) {
            const double level = picture.at(x, y)[1];
            sum += level;
            squares += level * level;
        }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0))};
}

TEST_F(BoneGrainTest, VariesTheColourAboutItsMean) {
    const BoneTextures bone = slab(corner_mm);
    for (const RendererChoice choice : {RendererChoice::raycast, RendererChoice::slices}) {
        const Levels plain = levels_of(drawn(bone, from_above(3.0), false, choice));
        const Levels grained = levels_of(drawn(bone, from_above(3.0), true, choice));
        EXPECT_LT(plain.deviation, 1.5);
        EXPECT_GT(grained.deviation, plain.deviation + 1.5);
        EXPECT_LT(grained.deviation, 12.0) << "small";
        EXPECT_NEAR(grained.mean, plain.mean, 3.0);
    }
    EXPECT_GT(levels_of(drawn(slab(corner_mm, 0.1), from_above(3.0), true)).deviation,
              1.5 * levels_of(drawn(bone, from_above(3.0), true)).deviation)
        << "trabecular bone's is stronger";
}

TEST_F(BoneGrainTest, StaysWithTheBoneWhereverItsBoxBegins) {
    const Picture one = drawn(slab(corner_mm), from_above(2.0), true);
    // Cropped otherwise, by whole voxels: the same bone at the same place.
    const Picture other = drawn(slab(corner_mm + glm::dvec3(0.7, 0.3, 0.0)), from_above(2.0), true);
    int greatest = 0;
    for (int y = 30; y < size_px.y - 30; ++y)
        for (int x = 30; x < size_px.x - 30; ++x)
            greatest = std::max(greatest, std::abs(one.at(x, y)[1] - other.at(x, y)[1]));
    EXPECT_LE(greatest, 2);
    EXPECT_EQ(drawn(slab(corner_mm), from_above(2.0), true), one) << "every time the same";
}

TEST_F(BoneGrainTest, IsGoneWhereAPixelCoversIt) {
    const BoneTextures bone = slab(corner_mm);
    Camera camera = from_above(3.0);
    camera.distance_mm = 300.0;
    camera.far_mm = 1000.0;
    ASSERT_GT(mm_per_px_at(camera, {0.0, 0.0, 0.0}, size_px), coarse_grain_mm);
    EXPECT_EQ(drawn(bone, camera, true), drawn(bone, camera, false));
}

}  // namespace
}  // namespace osteomill::bone_grain_test
