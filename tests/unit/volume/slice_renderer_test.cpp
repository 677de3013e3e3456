#include "render_client/volume/passes/slice_renderer.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::slice_renderer_test {
namespace {

const glm::ivec2 size_px(200, 150);
const Grid grid{.size_voxels = {96, 96, 80}, .origin_mm = {-4.75, -4.75, -3.95}};

class BothRenderers : public OffscreenTest, public ::testing::WithParamInterface<RendererChoice> {
  protected:
    /// Draws and leaves the picture, with its depth, in the framebuffer.
    const gl::Framebuffer& drawn(const BoneTextures& textures, const Camera& camera) {
        renderer_ = make_renderer(GetParam());
        framebuffer_ = std::make_unique<gl::Framebuffer>(size_px);
        framebuffer_->bind();
        renderer_->draw(textures, camera, size_px);
        return *framebuffer_;
    }
    void TearDown() override {
        renderer_.reset();
        framebuffer_.reset();
        OffscreenTest::TearDown();
    }

  private:
    std::unique_ptr<BoneRenderer> renderer_;
    std::unique_ptr<gl::Framebuffer> framebuffer_;
};

/// mm along the camera's axis that a depth of the framebuffer stands for.
double depth_mm(const Camera& camera, float window_depth) {
    const glm::dmat4 projection = camera.projection(size_px);
    const double clip = 2.0 * static_cast<double>(window_depth) - 1.0;
    return projection[3][2] / (projection[2][2] + clip);
}

/// A slab with a ball carved out of its upper face: from above, the rim is a circle.
struct CarvedSlab {
    static constexpr double top_mm = 1.0;
    static constexpr double radius_mm = 2.0;
    static constexpr double centre_height_mm = 1.5;

    CarvedSlab() { carve_sphere(bone, {0.0, 0.0, centre_height_mm}, radius_mm); }
    /// The height of the hollow's wall.
    static double height_mm(double from_axis_mm) {
        return centre_height_mm - std::sqrt(radius_mm * radius_mm - from_axis_mm * from_axis_mm);
    }

    Bone bone = made_bone(grid, [](const glm::dvec3& p) { return top_mm - p.z; });
};

TEST_P(BothRenderers, PickPointsOnACarvedSphereWithinHalfAVoxel) {
    const CarvedSlab slab;
    Camera camera = camera_on({0.0, 0.0, 0.0}, 4.0);
    camera.elevation_rad = 1.3;
    const BoneTextures textures(slab.bone, {});
    const gl::Framebuffer& picture = drawn(textures, camera);
    const glm::dmat4 to_patient = glm::inverse(camera.projection(size_px) * camera.view());
    int picked = 0;
    for (int y = 55; y < 95; y += 8)
        for (int x = 75; x < 125; x += 10) {
            const float depth = picture.depth_at({x, y});
            const glm::dvec4 clip(2.0 * (x + 0.5) / size_px.x - 1.0, 2.0 * (y + 0.5) / size_px.y - 1.0,
                                  2.0 * static_cast<double>(depth) - 1.0, 1.0);
            const glm::dvec4 place = to_patient * clip;
            const glm::dvec3 point_mm = glm::dvec3(place) / place.w;
            EXPECT_NEAR(glm::dot(point_mm - camera.eye_mm(), camera.forward()), depth_mm(camera, depth),
                        1e-3);
            const double from_axis_mm = std::hypot(point_mm.x, point_mm.y);
            if (from_axis_mm > 1.6) continue;
            const double from_centre_mm = glm::length(point_mm - glm::dvec3(0, 0, slab.centre_height_mm));
            EXPECT_NEAR(from_centre_mm, slab.radius_mm, 0.5 * grid.spacing_mm) << x << ' ' << y;
            ++picked;
        }
    EXPECT_GT(picked, 12);
}

// The ball carved away reaches past both faces of a thin plate, and leaves a hole with a circle for an edge:
// the narrowest one, in the ball's middle.
TEST_P(BothRenderers, ShowTheRimOfACarvedSphereWithinHalfAVoxel) {
    const double radius_mm = 2.0;
    Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 0.5 - std::abs(p.z); });
    carve_sphere(bone, {0.0, 0.0, 0.0}, radius_mm);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 3.2);
    camera.azimuth_rad = 0.0;
    camera.elevation_rad = 89.0 * std::acos(-1.0) / 180.0;
    const BoneTextures textures(bone, {});
    const gl::Framebuffer& picture = drawn(textures, camera);
    // Seen from the height d above the middle, the hole of a plate of half thickness h is bounded by the rim
    // of the upper face (radius sqrt(r^2 - h^2), at distance d - h), of the lower one, or by a tangent of the
    // ball: by the one that is seen under the smallest angle, all round.
    const double d = camera.distance_mm, h = 0.5;
    const double rim_mm = std::sqrt(radius_mm * radius_mm - h * h);
    const double tangent = std::min({rim_mm / (d - h), rim_mm / (d + h)});
    const double px_per_tangent = 0.5 * size_px.y / std::tan(0.5 * camera.field_of_view_rad);
    const double voxel_px = grid.spacing_mm / mm_per_px_at(camera, camera.target_mm, size_px);
    int hole_px = 0;
    for (int x = 0; x < size_px.x; ++x)
        if (x > size_px.x / 4 && x < 3 * size_px.x / 4 && picture.depth_at({x, size_px.y / 2}) == 1.0f)
            ++hole_px;
    EXPECT_NEAR(0.5 * hole_px, px_per_tangent * tangent, 0.5 * voxel_px + 0.5);
}

TEST_P(BothRenderers, DrawTheSameFromAnAtlasAfterCarvingInBothShadings) {
    for (const Shading shading : {Shading::gradient, Shading::surface_voxels}) {
        // Not within half a voxel of the box, where a dense texture knows nothing beyond.
        Bone bone = made_bone(grid, [](const glm::dvec3& p) { return 3.3 - glm::length(p); });
        const ShadingSettings look{.shading = shading};
        BoneTextures dense(bone, {}, look, {.layout = BoneLayout::dense});
        BoneTextures atlas(bone, {}, look, {.layout = BoneLayout::atlas});
        const auto changes = carve_sphere(bone, {0.4, -2.1, 2.2}, 1.1);
        dense.update(bone, changes);
        atlas.update(bone, changes);
        const BoneTextures fresh(bone, {}, look);
        const Camera camera = camera_on({0.0, 0.0, 0.0}, 5.0);
        const Picture picture = drawn(dense, camera).read_back();
        EXPECT_EQ(picture, drawn(fresh, camera).read_back());
        const Picture of_atlas = drawn(atlas, camera).read_back();
        int most = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); ++i)
            most = std::max(most, std::abs(picture.rgb[i] - of_atlas.rgb[i]));
        EXPECT_LE(most, 2) << "beyond rounding";
    }
}

TEST_P(BothRenderers, ShowWhatIsBehindHiddenBoneAndNothingOfIt) {
    const std::array<TissueColour, 2> solid{{{1, {230, 20, 20}}, {2, {20, 230, 20}}}};
    std::array<TissueColour, 2> hidden = solid;
    hidden[0].opacity = 0.0;
    const Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return 2.0 - p.z; },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 0.5 ? 1 : 2); });
    Camera camera = camera_on({0.0, 0.0, 1.0}, 4.0);
    camera.elevation_rad = 1.5;
    const auto middle = [&](std::span<const TissueColour> tissues) {
        const BoneTextures textures(bone, tissues);
        const Picture picture = drawn(textures, camera).read_back();
        const std::uint8_t* pixel = picture.at(size_px.x / 2, size_px.y / 2);
        return glm::ivec3(pixel[0], pixel[1], pixel[2]);
    };
    EXPECT_GT(middle(solid).r, 2 * middle(solid).g);
    EXPECT_GT(middle(hidden).g, 2 * middle(hidden).r);
    std::array<TissueColour, 2> seen_through = solid;
    seen_through[0].opacity = 0.3;
    EXPECT_GT(middle(seen_through).g, middle(solid).g + 20);
    EXPECT_GT(middle(seen_through).r, middle(hidden).r + 20);
}

INSTANTIATE_TEST_SUITE_P(Each, BothRenderers,
                         ::testing::Values(RendererChoice::raycast, RendererChoice::slices),
                         [](const auto& tested) {
                             return tested.param == RendererChoice::raycast ? "Raycast" : "Slices";
                         });

}  // namespace
}  // namespace osteomill::slice_renderer_test
