#include "render_client/volume/thin_bone.h"

#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/shaders/lighting.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::thin_bone_test {
namespace {

using ThinBoneTest = OffscreenTest;

constexpr double depth_mm = 1.5, strength = 0.9;
const TissueColour bone_colour{1, {230, 210, 170}};
const TissueColour sinus_colour{2, {40, 70, 170}, 1.0, depth_mm, strength};
const std::array<TissueColour, 2> tissues{{bone_colour, sinus_colour}};
const Grid grid{.size_voxels = {96, 96, 64}, .origin_mm = {-4.75, -4.75, -3.15}};
const glm::ivec2 size_px(120, 90);

TEST(ThinBone, TakesOnTheStrengthAtNoDepthAndNothingFromTheDepthOn) {
    EXPECT_DOUBLE_EQ(share_through_bone(0.8, 0.0), 0.8);
    EXPECT_NEAR(share_through_bone(0.8, 1.0), 0.0, 1e-12);
    EXPECT_EQ(share_through_bone(0.8, 1.2), 0.0);
    for (double way = 0.1; way < 0.95; way += 0.1) {
        EXPECT_LT(share_through_bone(0.8, way), share_through_bone(0.8, way - 0.1));
        // A second layer as thick takes as large a part of the light again.
        const double least = std::exp(-1.0), scale = 1.0 - least;
        EXPECT_NEAR(share_through_bone(1.0, way) * scale + least, std::exp(-way), 1e-12);
    }
}

/// A flat bone up to z = top_mm, of the second tissue below z = 0.
Bone layered(double top_mm) {
    return made_bone(
        grid, [=](const glm::dvec3& p) { return std::min(top_mm - p.z, p.z + 2.5); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 0.0 ? 1 : 2); });
}

Camera from_above(double elevation_rad = 1.57) {
    Camera camera = camera_on({0.0, 0.0, 0.0}, 2.0);
    camera.elevation_rad = elevation_rad;
    return camera;
}

Picture drawn(const BoneTextures& textures, const Camera& camera, bool thin_bone = true) {
    RaycastRenderer renderer;
    renderer.set_appearance({.thin_bone = thin_bone});
    const gl::Framebuffer framebuffer(size_px);
    framebuffer.bind();
    renderer.draw(textures, camera, size_px);
    return framebuffer.read_back();
}

glm::dvec3 linear_at(const Picture& picture, const glm::ivec2& place) {
    const std::uint8_t* rgb = picture.at(place.x, place.y);
    return glm::pow(glm::dvec3(rgb[0], rgb[1], rgb[2]) / 255.0, glm::dvec3(2.2));
}

/// Share of the second tissue in the colour at a place. Light is the same with it and without.
double share_at(const Picture& with, const Picture& without, const glm::ivec2& place) {
    const glm::dvec3 own(linear_from_srgb(bone_colour.srgb)),
        other(colour_under_bone(linear_from_srgb(sinus_colour.srgb)));
    return (1.0 - linear_at(with, place).r / linear_at(without, place).r) / (1.0 - other.r / own.r);
}

double share_in_middle(const BoneTextures& textures, const Camera& camera) {
    return share_at(drawn(textures, camera), drawn(textures, camera, false), size_px / 2);
}

TEST_F(ThinBoneTest, ShowsATissueBehindLayersByTheFormula) {
    double before = 1.0;
    for (const double thickness_mm : {0.3, 0.45, 0.6, 0.8, 1.0, 1.2, 1.4, 1.7, 2.2}) {
        const BoneTextures textures(layered(thickness_mm), tissues);
        const double share = share_in_middle(textures, from_above());
        EXPECT_NEAR(share, share_through_bone(strength, thickness_mm / depth_mm), 0.02) << thickness_mm;
        if (thickness_mm < depth_mm) {
            EXPECT_LT(share, before) << thickness_mm;
        }
        before = share;
    }
}

TEST_F(ThinBoneTest, CountsTheWayOfARayThatGoesAslant) {
    const double elevation = 0.9, thickness_mm = 0.6;
    const BoneTextures textures(layered(thickness_mm), tissues);
    const double way_mm = thickness_mm / std::sin(elevation);
    Camera camera = from_above(elevation);
    camera.target_mm = {0.0, 0.0, thickness_mm};
    EXPECT_NEAR(share_in_middle(textures, camera), share_through_bone(strength, way_mm / depth_mm), 0.03);
}

/// Height over a plane through the origin of the surface in a picture's pixel.
double height_mm(const gl::Framebuffer& framebuffer, const Camera& camera, const glm::dvec3& normal,
                 const glm::ivec2& pixel) {
    const glm::dmat4 projection = camera.projection(size_px);
    const double window_depth = framebuffer.depth_at({pixel.x, size_px.y - 1 - pixel.y});
    const double forward_mm = projection[3][2] / (2.0 * window_depth - 1.0 + projection[2][2]);
    const glm::dvec3 direction = direction_through(camera, glm::dvec2(pixel) + 0.5, size_px);
    return glm::dot(camera.eye_mm() + forward_mm / glm::dot(direction, camera.forward()) * direction, normal);
}

TEST_F(ThinBoneTest, TintsASlantedLayerEvenly) {
    constexpr double thickness_mm = 0.2, shallow_mm = 0.6;
    const auto tissues_with = [](double strength_of_tissue) {
        return std::array<TissueColour, 2>{
            {bone_colour, {2, sinus_colour.srgb, 1.0, shallow_mm, strength_of_tissue}}};
    };
    for (const glm::dvec3& slope : {glm::dvec3(0.18, 0.05, 1.0), glm::dvec3(0.35, 0.2, 1.0),
                                    glm::dvec3(-0.18, 0.47, 1.0), glm::dvec3(0.7, 0.5, 1.0)}) {
        const glm::dvec3 normal = glm::normalize(slope);
        const Bone bone = made_bone(
            grid,
            [&](const glm::dvec3& p) {
                const double height = glm::dot(p, normal);
                return std::min(thickness_mm - height, height + 1.5);
            },
            [&](const glm::dvec3& p) {
                return static_cast<std::uint8_t>(glm::dot(p, normal) > 0.0 ? 1 : 2);
            });
        const BoneTextures textures(bone, tissues_with(strength)), hardly(bone, tissues_with(1e-4));
        Camera camera = camera_on({0.0, 0.0, 0.0}, 2.0);
        look_along(camera, -normal);
        const Picture without = drawn(hardly, camera);
        RaycastRenderer renderer;
        const gl::Framebuffer framebuffer(size_px);
        framebuffer.bind();
        renderer.draw(textures, camera, size_px);
        const Picture with = framebuffer.read_back();
        // A millimetre to either side of the middle, which rays meet at a right angle nearly. The bone's own
        // surface is not quite even, either.
        double count = 0.0, sum = 0.0, squares = 0.0;
        const glm::ivec2 middle = size_px / 2;
        for (int y = -20; y <= 20; ++y)
            for (int x = -20; x <= 20; ++x, ++count) {
                const glm::ivec2 pixel = middle + glm::ivec2(x, y);
                const double height = height_mm(framebuffer, camera, normal, pixel);
                ASSERT_NEAR(height, thickness_mm, 0.02);
                const double off =
                    share_at(with, without, pixel) - share_through_bone(strength, height / shallow_mm);
                sum += off;
                squares += off * off;
            }
        const double mean = sum / count;
        EXPECT_NEAR(mean, 0.0, 0.05) << "slope " << slope.x;
        EXPECT_LT(std::sqrt(squares / count - mean * mean), 0.01) << "ripple, slope " << slope.x;
    }
}

/// A layer of two voxels over a slanted tissue, milled out of thick bone: stiffness varies, so that looks are
/// read 2.5 voxels deep.
TEST_F(ThinBoneTest, HasItsOwnColourHoweverThinItIs) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.35, 0.2, 1.0));
    const Bone bone =
        filled(BoneBuilder::heterogeneous(grid, 1.0 / 200.0, true), grid, [&](const glm::ivec3& voxel) {
            const double height = glm::dot(centre_of_voxel_mm(grid, voxel), normal);
            return VoxelValues{
                .fraction = fraction_of_depth(std::min(0.2 - height, height + 1.5), grid.spacing_mm),
                .stiffness = static_cast<std::uint8_t>(100 + 40 * (voxel.x % 2)),
                .tissue = static_cast<std::uint8_t>(height > 0.0 ? 1 : 2)};
        });
    const std::array<TissueColour, 2> hardly_seen{
        {bone_colour, {2, sinus_colour.srgb, 1.0, depth_mm, 0.001}}};
    const BoneTextures textures(bone, hardly_seen);
    ASSERT_GT(textures.colour_depth_voxels(), 2.0);
    Camera camera = camera_on({0.0, 0.0, 0.0}, 2.0);
    look_along(camera, -normal);
    const Picture picture = drawn(textures, camera);
    for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x) {
            const glm::dvec3 colour = linear_at(picture, size_px / 2 + glm::ivec2(x, y));
            ASSERT_GT(colour.r, colour.b) << "bone is yellowish, the tissue blue: " << x << ", " << y;
        }
}

/// Two tissues that meet under a layer, and a third whose number is between theirs.
TEST_F(ThinBoneTest, BlendsTwoTissuesThatMeetAndShowsNoOther) {
    const std::array<TissueColour, 4> four{{{1, {150, 150, 150}},
                                            {2, {0, 0, 255}, 1.0, depth_mm, strength},
                                            {3, {255, 0, 0}, 1.0, depth_mm, strength},
                                            {4, {0, 255, 0}, 1.0, depth_mm, strength}}};
    const Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return std::min(0.3 - p.z, p.z + 2.5); },
        [](const glm::dvec3& p) {
            return static_cast<std::uint8_t>(p.z > 0.0 ? 1 : p.x + 0.3 * p.y < 0.03 ? 2 : 4);
        });
    const Picture picture = drawn(BoneTextures(bone, four), from_above());
    for (int y = 20; y < size_px.y - 20; ++y) {
        double most = 0.0, before = linear_at(picture, {20, y}).g;
        for (int x = 20; x < size_px.x - 20; ++x) {
            const glm::dvec3 colour = linear_at(picture, {x, y});
            EXPECT_LT(colour.r, 0.2) << "red is nowhere: " << x << ", " << y;
            most = std::max(most, std::abs(colour.g - before));
            before = colour.g;
        }
        const double change = std::abs(before - linear_at(picture, {20, y}).g);
        EXPECT_GT(change, 0.2);
        EXPECT_LT(most, 0.35 * change) << "an edge in row " << y;
    }
}

TEST_F(ThinBoneTest, FollowsTheBurrThroughBoneIntoTheTissueAndBack) {
    const Bone whole = layered(2.0);
    Bone bone = whole;
    BoneTextures textures(bone, tissues);
    const Picture before = drawn(textures, from_above());
    // A wide ball down to 0.5 mm over the tissue.
    auto carved = carve_sphere(bone, {0.0, 0.0, 3.5}, 3.0);
    textures.update(bone, carved);
    EXPECT_NEAR(share_in_middle(textures, from_above()), share_through_bone(strength, 0.5 / depth_mm), 0.06);
    EXPECT_EQ(drawn(textures, from_above()), drawn(BoneTextures(bone, tissues), from_above()));
    // From below through the tissue up to the layer: then there is nothing to be seen behind it.
    const auto opened = carve_sphere(bone, {0.0, 0.0, -2.6}, 2.7);
    const std::span<const VoxelBox> changed = textures.update(bone, opened);
    EXPECT_GT(changed.size(), opened.size()) << "what looks different is more than what changed";
    EXPECT_LT(share_in_middle(textures, from_above()), 0.01);
    EXPECT_EQ(drawn(textures, from_above()), drawn(BoneTextures(bone, tissues), from_above()));
    carved.insert(carved.end(), opened.begin(), opened.end());
    textures.update(whole, carved);
    EXPECT_EQ(drawn(textures, from_above()), before);
}

TEST_F(ThinBoneTest, ShowsASoftStructureBesideTheBone) {
    const Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return std::min(0.6 - p.z, p.z); },
        [](const glm::dvec3&) { return std::uint8_t{1}; });
    BoneTextures textures(bone, tissues);
    const Picture before = drawn(textures, from_above());
    EXPECT_EQ(before, drawn(textures, from_above(), false));
    std::vector<StructureBrick> bricks;
    const glm::ivec3 size = size_in_bricks(grid);
    for (int number = 0; number < size.x * size.y * size.z; ++number) {
        StructureBrick brick{.brick = static_cast<BrickIndex>(number)};
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, brick.brick);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (centre_of_voxel_mm(grid, first + voxel_in_brick(offset)).z < 0.0) brick.voxels.set(offset);
        if (brick.voxels.any()) bricks.push_back(brick);
    }
    textures.add_structure(2, StructureMask(grid, std::move(bricks)));
    int pieces = 0;
    while (!textures.work(bone).empty()) ++pieces;
    EXPECT_GT(pieces, 0);
    EXPECT_NEAR(share_in_middle(textures, from_above()), share_through_bone(strength, 0.6 / depth_mm), 0.02);
}

TEST_F(ThinBoneTest, IsOfTheUsualLookAlone) {
    const Bone bone = layered(0.5);
    EXPECT_NE(BoneTextures(bone, tissues).seen_through(), nullptr);
    EXPECT_EQ(BoneTextures(bone, tissues, {.shading = Shading::surface_voxels}).seen_through(), nullptr);
    EXPECT_EQ(BoneTextures(bone, tissues, {.transfer = transfer_presets()[0]}).seen_through(), nullptr);
    EXPECT_EQ(BoneTextures(bone, {&bone_colour, 1}).seen_through(), nullptr);
    const BoneTextures textures(bone, tissues);
    std::size_t bytes = 0;
    for (const TextureSize& each : textures.sizes()) bytes += each.bytes;
    EXPECT_EQ(bytes, textures.plan().bytes);
}

}  // namespace
}  // namespace osteomill::thin_bone_test
