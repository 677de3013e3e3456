#include "render_client/volume/textures/sawn_faces.h"

#include <glm/exponential.hpp>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::sawn_faces_test {
namespace {

using SawnFacesTest = OffscreenTest;

const Grid grid{.size_voxels = {96, 96, 80}, .origin_mm = {-4.75, -4.75, -3.95}};
const glm::ivec2 size_px(120, 90);

/// Voxel coordinates in which voxel i spans i to i + 1.
double face_voxels(double place_mm, int axis) {
    return (place_mm - grid.origin_mm[axis]) / grid.spacing_mm + 0.5;
}

/// A round bar along y that is sawn off at these places and rounded all about.
Bone bar(double front_mm, double back_mm) {
    return made_bone(
        grid,
        [=](const glm::dvec3& p) {
            return std::min({2.5 - glm::length(glm::dvec2(p.x, p.z)), p.y - front_mm, back_mm - p.y});
        },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 0.0 ? 1 : 2); });
}

TEST(SawnFaces, LieWhereAPieceIsSawnOffAndNowhereElse) {
    for (const auto& [front_mm, back_mm] :
         {std::pair{-4.0, 3.0}, std::pair{-3.93, 3.04}, std::pair{-20.0, 2.97}}) {
        const SawnFaces faces = sawn_faces(bar(front_mm, back_mm));
        EXPECT_TRUE(faces.any());
        // A piece that goes on beyond the grid ends with it.
        EXPECT_NEAR(faces.low.y, std::max(face_voxels(front_mm, 1), 0.0), 0.1) << front_mm;
        EXPECT_NEAR(faces.high.y, face_voxels(back_mm, 1), 0.1) << back_mm;
        for (const int axis : {0, 2}) {
            EXPECT_EQ(faces.low[axis], -SawnFaces::none);
            EXPECT_EQ(faces.high[axis], SawnFaces::none);
        }
    }
}

TEST(SawnFaces, AreNoneOfRoundBone) {
    for (const double radius_mm : {0.8, 2.0, 3.5}) {
        const Bone ball = made_bone(grid, [=](const glm::dvec3& p) { return radius_mm - glm::length(p); });
        EXPECT_FALSE(sawn_faces(ball).any()) << radius_mm;
    }
    // A vault whose middle is far outside the grid.
    const Bone vault = made_bone(
        grid, [](const glm::dvec3& p) { return 60.0 - glm::length(p - glm::dvec3(0.0, 0.0, -57.0)); });
    EXPECT_EQ(sawn_faces(vault).high.z, SawnFaces::none);
    EXPECT_NEAR(sawn_faces(vault).low.x, 0.0, 0.1);
}

TEST(SawnFaces, StayWhereAGrooveIsMilledIntoThem) {
    Bone bone = bar(-4.0, 3.0);
    carve_sphere(bone, {0.0, -4.0, 0.0}, 0.6);
    EXPECT_NEAR(sawn_faces(bone).low.y, face_voxels(-4.0, 1), 0.1);
}

TEST_F(SawnFacesTest, AreNeutralAndBoneBesideThemIsNot) {
    const std::array<TissueColour, 2> colours{{{1, {30, 70, 200}}, {2, {220, 60, 40}}}};
    const BoneTextures textures(bar(-4.0, 3.0), colours);
    for (const RendererChoice choice : {RendererChoice::raycast, RendererChoice::slices}) {
        const auto renderer = make_renderer(choice);
        const gl::Framebuffer framebuffer(size_px);
        const auto drawn = [&](const Camera& camera, bool neutral) {
            renderer->set_appearance({.neutral_sawn_faces = neutral});
            framebuffer.bind();
            renderer->draw(textures, camera, size_px);
            return framebuffer.read_back();
        };
        Camera to_face = camera_on({0.0, -4.0, 0.0}, 3.0);
        to_face.elevation_rad = 0.0;
        const Picture neutral = drawn(to_face, true), coloured = drawn(to_face, false);
        for (const int above : {-15, -5, 5, 15}) {
            const std::uint8_t* face = neutral.at(60, 45 - above);
            const auto [darkest, brightest] = std::minmax({face[0], face[1], face[2]});
            EXPECT_LT(brightest - darkest, 40) << above;
            EXPECT_GT(brightest, 90) << above;
            const std::uint8_t* own = coloured.at(60, 45 - above);
            EXPECT_GT(std::abs(own[0] - own[2]), 80) << above;
        }
        // From above and behind: no face is seen.
        Camera to_side = camera_on({0.0, 0.0, 0.0}, 2.0);
        to_side.elevation_rad = 1.57;
        EXPECT_EQ(drawn(to_side, true), drawn(to_side, false));
    }
}

}  // namespace
}  // namespace osteomill::sawn_faces_test
