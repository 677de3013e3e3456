#include "render_client/volume/textures/surface_voxels.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "render_client/volume/shaders/lighting.h"
#include "render_client/volume/textures/voxel_box.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::surface_voxels_test {
namespace {

using SurfaceTextureTest = OffscreenTest;

const Grid grid{.size_voxels = {48, 48, 48}, .origin_mm = {-2.35, -2.35, -2.35}};

Bone ball() {
    return made_bone(grid, [](const glm::dvec3& p) { return 1.9 - glm::length(p); });
}

VoxelBox whole() {
    return {{0, 0, 0}, grid.size_voxels};
}

std::size_t place(const glm::ivec3& voxel) {
    return (static_cast<std::size_t>(voxel.z) * 48 + voxel.y) * 48 + voxel.x;
}

/// The definition, voxel by voxel: at least half full, with a neighbour that is not.
bool is_on_surface(const Bone& bone, const glm::ivec3& voxel) {
    if (bone.fraction_at(voxel) < 128) return false;
    for (int i = 0; i < 27; ++i)
        if (bone.fraction_at(voxel + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1) < 128) return true;
    return false;
}

TEST(SurfaceVoxels, AreThoseInsideWithANeighbourOutside) {
    const Bone bone = ball();
    const auto texels = SurfaceShader(transfer_table(bone.content(), {}, {})).shade(bone, whole());
    int surface = 0;
    for (int z = 0; z < 48; ++z)
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                const glm::ivec3 voxel(x, y, z);
                ASSERT_EQ(texels[place(voxel)].a == 255, is_on_surface(bone, voxel));
                surface += texels[place(voxel)].a == 255 ? 1 : 0;
            }
    // A shell of the ball, between one and two voxels thick.
    const double area_voxels = 4.0 * std::acos(-1.0) * 19.0 * 19.0;
    EXPECT_GT(surface, 0.9 * area_voxels);
    EXPECT_LT(surface, 2.0 * area_voxels);
}

TEST(SurfaceVoxels, AreLitByTheNormalOfTheBall) {
    const Bone bone = ball();
    const TransferTable table = transfer_table(bone.content(), {}, {});
    const auto texels = SurfaceShader(table).shade(bone, whole());
    double sum = 0.0;
    int count = 0;
    for (int z = 0; z < 48; ++z)
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                const SurfaceTexel& texel = texels[place({x, y, z})];
                if (texel.a == 0) continue;
                const glm::dvec3 normal = glm::normalize(centre_of_voxel_mm(grid, {x, y, z}));
                const glm::dvec3 expected = display(lit(glm::dvec3(table.by_code[0]), normal, 1.0));
                sum += std::abs(texel.g / 255.0 - expected.g);
                ++count;
            }
    ASSERT_GT(count, 1000);
    EXPECT_LT(sum / count, 0.005);
}

/// The definition in double precision; alpha 0 if it is no surface voxel.
glm::dvec4 defined_texel(const Bone& bone, const TransferTable& table, const glm::ivec3& voxel) {
    if (!is_on_surface(bone, voxel)) return glm::dvec4(0.0);
    FractionSmoother smoother(table);
    const std::span<const std::uint8_t> smoothed = smoother.smooth(bone, {voxel - 1, glm::ivec3(3)});
    glm::dvec3 outward(0.0);
    for (int i = 0; i < 27; ++i) {
        if (i == 13) continue;
        const glm::ivec3 step = glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
        const double distance = glm::length(glm::dvec3(step));
        const int falls = smoothed[13] - smoothed[static_cast<std::size_t>(i)];
        outward += falls / distance * (glm::dvec3(step) / distance);
    }
    const glm::dvec3 normal = glm::length(outward) > 1e-9 ? glm::normalize(outward) : glm::dvec3(0, 0, 1);
    const glm::dvec3 colour(table.by_code[bone.tissue_at(voxel)]);
    return {255.0 * display(lit(colour, normal, 1.0)), 255.0};
}

TEST(SurfaceVoxels, HaveTheColourOfTheirDefinitionInRowsOfAnyLength) {
    // Fractions and labels without any order, in rows of more voxels than a word has bits.
    const Grid rows{.size_voxels = {144, 16, 16}};
    Bone bone = made_bone(
        rows, [](const glm::dvec3&) { return 1.0; },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.y > 0.7 ? 1 : 2); });
    std::uint32_t state = 1;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        for (std::uint8_t& fraction : bone.fractions(static_cast<std::int32_t>(slot))) {
            state = 1664525U * state + 1013904223U;  // Knuth's generator
            fraction = static_cast<std::uint8_t>(state >> 28U < 2U ? state >> 20U : 255U);
        }
    const std::vector<TissueColour> tissues{{1, {200, 120, 80}}, {2, {90, 160, 240}}};
    const TransferTable table = transfer_table(bone.content(), tissues, {});
    const VoxelBox box{{-1, 0, 2}, {146, 16, 15}};
    const auto texels = SurfaceShader(table).shade(bone, box);
    ASSERT_EQ(texels.size(), box.count());
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto n = static_cast<int>(i);
        const glm::ivec3 voxel = box.first + glm::ivec3(n % 146, n / 146 % 16, n / (146 * 16));
        const glm::dvec4 expected = defined_texel(bone, table, voxel);
        ASSERT_EQ(texels[i].a, expected.a) << voxel.x << ' ' << voxel.y << ' ' << voxel.z;
        ASSERT_NEAR(texels[i].r, expected.r, 8.0);
        ASSERT_NEAR(texels[i].g, expected.g, 8.0);
        ASSERT_NEAR(texels[i].b, expected.b, 8.0);
        sum += std::abs(texels[i].g - expected.g);
        count += expected.a > 0.0 ? 1 : 0;
    }
    // Directions are looked up: a degree matters where the key light begins, and hardly elsewhere.
    ASSERT_GT(count, 10000);
    EXPECT_LT(sum / count, 0.7);
}

TEST_F(SurfaceTextureTest, IsShadedAgainOnlyRoundTheChangeAndEqualsAFreshOne) {
    for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas}) {
        Bone bone = ball();
        const TransferTable table = transfer_table(bone.content(), {}, {});
        AtlasLayout places(bone.content(), layout, gl::max_texture3d_edge());
        SurfaceTexture updated(bone, table, places);
        // At the corner of bricks, so that neighbours' voxels become surface, too.
        const auto changes = carve_sphere(bone, {0.75, 0.75, 1.2}, 0.8);
        updated.update(bone, places, changed_boxes(bone.content(), changes));
        const SurfaceTexture fresh(bone, table, places);
        const auto texels = [&](const SurfaceTexture& surface) {
            std::vector<std::uint8_t> bytes(4 * VoxelBox{{}, places.texture_size()}.count());
            surface.texture().read_back(bytes);
            return bytes;
        };
        // Tiles that no brick has may hold anything.
        const auto expected = texels(fresh), found = texels(updated);
        const glm::ivec3 size = places.texture_size();
        for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
            const glm::ivec3 brick =
                brick_position(bone.content().size_bricks, bone.content().brick_of_slot[slot]);
            const PlacedVoxels placed = places.of_brick(brick, static_cast<std::int32_t>(slot));
            for (std::size_t i = 0; i < placed.voxels.count(); ++i) {
                const glm::ivec3 edge = placed.voxels.size;
                const auto n = static_cast<int>(i);
                const glm::ivec3 texel =
                    placed.first_texel + glm::ivec3(n % edge.x, n / edge.x % edge.y, n / (edge.x * edge.y));
                const std::size_t at =
                    4 * ((static_cast<std::size_t>(texel.z) * size.y + texel.y) * size.x + texel.x);
                ASSERT_EQ(found[at + 3], expected[at + 3]);
                ASSERT_EQ(found[at], expected[at]);
            }
        }
    }
}

}  // namespace
}  // namespace osteomill::surface_voxels_test
