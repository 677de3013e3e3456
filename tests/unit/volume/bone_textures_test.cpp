#include "render_client/volume/textures/bone_textures.h"

#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::bone_textures_test {
namespace {

using BoneTexturesTest = OffscreenTest;

const Grid grid{.size_voxels = {90, 70, 50}, .origin_mm = {0.05, 0.05, 0.05}};

Bone ball() {
    return made_bone(grid,
                     [](const glm::dvec3& p) { return 1.9 - glm::length(p - glm::dvec3(5.0, 4.0, 2.5)); });
}

std::vector<std::uint8_t> texels(const gl::Texture3D& texture, std::size_t bytes_per_texel = 1) {
    std::vector<std::uint8_t> bytes(bytes_per_texel * VoxelBox{{}, texture.size()}.count());
    texture.read_back(bytes);
    return bytes;
}

TEST_F(BoneTexturesTest, HoldTheBoneCroppedToItsBricks) {
    const Bone bone = ball();
    const BoneTextures textures(bone, {});
    EXPECT_EQ(textures.box(), stored_box(bone.content()));
    std::vector<std::uint8_t> expected(textures.box().count());
    copy_channel(bone, BoneChannel::fraction, textures.box(), expected);
    EXPECT_EQ(texels(textures.fraction()), expected);
}

TEST_F(BoneTexturesTest, TakeAsManyBytesAsWerePlanned) {
    const Bone bone = ball();
    for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas})
        for (const Shading shading : {Shading::gradient, Shading::surface_voxels}) {
            const BoneTextures textures(bone, {}, {.shading = shading}, {.layout = layout});
            std::size_t bytes = 0;
            for (const TextureSize& each : textures.sizes()) bytes += each.bytes;
            EXPECT_EQ(bytes, textures.plan().bytes);
        }
}

/// Mean fractions of all blocks; the distances beside them may be shorter after a carve than they must be.
std::vector<std::uint8_t> mean_fractions(const BoneTextures& textures) {
    const std::vector<std::uint8_t> pairs = texels(textures.blocks(), 2);
    std::vector<std::uint8_t> means;
    for (std::size_t block = 0; block < pairs.size(); block += 2) means.push_back(pairs[block]);
    return means;
}

TEST_F(BoneTexturesTest, AreTheSameByDirtyBricksAsByAFullUploadInBothLayouts) {
    for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas}) {
        Bone bone = ball();
        const Bone whole = bone;
        const TextureLimits limits{.layout = layout};
        BoneTextures updated(bone, {}, {}, limits);
        const std::vector<std::uint8_t> before = texels(updated.fraction());
        const auto changes = carve_sphere(bone, {4.2, 3.5, 4.0}, 1.1);
        ASSERT_FALSE(changes.empty());
        ASSERT_LT(changes.size(), bone.stored_bricks());
        updated.update(bone, changes);
        const BoneTextures uploaded(bone, {}, {}, limits);
        EXPECT_EQ(texels(updated.fraction()), texels(uploaded.fraction()));
        EXPECT_EQ(mean_fractions(updated), mean_fractions(uploaded));
        updated.update(whole, changes);
        EXPECT_EQ(texels(updated.fraction()), before);
    }
}

TEST_F(BoneTexturesTest, HoldInAnAtlasEachBrickWithTheVoxelsAroundIt) {
    const Bone bone = ball();
    const BoneTextures textures(bone, {}, {}, {.layout = BoneLayout::atlas});
    const std::vector<std::uint8_t> atlas = texels(textures.fraction());
    const glm::ivec3 size = textures.fraction().size();
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 brick = brick_position(content.size_bricks, content.brick_of_slot[slot]);
        const PlacedVoxels tile = textures.places().of_brick(brick, static_cast<std::int32_t>(slot));
        for (int z = 0; z < tile_edge_texels; ++z)
            for (int y = 0; y < tile_edge_texels; ++y)
                for (int x = 0; x < tile_edge_texels; ++x) {
                    const glm::ivec3 texel = tile.first_texel + glm::ivec3(x, y, z);
                    const std::size_t place =
                        (static_cast<std::size_t>(texel.z) * size.y + texel.y) * size.x + texel.x;
                    ASSERT_EQ(atlas[place], bone.fraction_at(tile.voxels.first + glm::ivec3(x, y, z)));
                }
    }
}

TEST_F(BoneTexturesTest, HoldNoColourCodesForAHomogeneousBone) {
    EXPECT_FALSE(BoneTextures(ball(), {}).colour_code().has_value());
}

TEST_F(BoneTexturesTest, HoldTheLabelsOfALabelledBone) {
    const Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return 1.9 - glm::length(p - glm::dvec3(5.0, 4.0, 2.5)); },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > 2.0 ? 3 : 4); });
    const BoneTextures textures(bone, {});
    ASSERT_TRUE(textures.colour_code().has_value());
    std::vector<std::uint8_t> expected(textures.box().count());
    copy_channel(bone, BoneChannel::tissue, textures.box(), expected);
    EXPECT_EQ(texels(*textures.colour_code()), expected);
}

TEST_F(BoneTexturesTest, TakeAnAtlasForABoneThatExceedsTheDriversTextures) {
    const Grid wide{.size_voxels = {gl::max_texture3d_edge() + 16, 16, 16}};
    const double last_mm = wide.spacing_mm * (wide.size_voxels.x - 1);
    const Bone bone =
        made_bone(wide, [&](const glm::dvec3& p) { return p.x < 1.0 || p.x > last_mm - 1.0 ? 1.0 : -1.0; });
    const BoneTextures textures(bone, {});
    EXPECT_EQ(textures.plan().layout, BoneLayout::atlas);
    EXPECT_EQ(textures.plan().coarsening, 1);
    EXPECT_EQ(textures.box().size.x, wide.size_voxels.x);
}

TEST_F(BoneTexturesTest, AskTheDriverForTheBytesThatTheyPlanned) {
    const Bone bone = ball();
    for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas}) {
        const BoneTextures textures(bone, {}, {}, {.layout = layout});
        ASSERT_NE(textures.smoothed(), nullptr);
        std::size_t bytes = VoxelBox{{}, textures.fraction().size()}.count();
        bytes += VoxelBox{{}, textures.smoothed()->size()}.count();
        bytes += 2 * VoxelBox{{}, textures.blocks().size()}.count();
        if (textures.tile_table()) bytes += 4 * VoxelBox{{}, textures.tile_table()->size()}.count();
        EXPECT_EQ(textures.plan().bytes, bytes);
    }
}

TEST_F(BoneTexturesTest, RefuseABoneThatFitsInNoWayAndSayWhatTheLimitIs) {
    try {
        BoneTextures(ball(), {}, {}, {.budget_bytes = 1000});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("0 MiB"), std::string::npos) << error.what();
    }
}

TEST_F(BoneTexturesTest, RefuseABoneWithoutAnyVoxel) {
    const Bone bone = made_bone(grid, [](const glm::dvec3&) { return -1.0; });
    EXPECT_THROW(BoneTextures(bone, {}), std::runtime_error);
}

}  // namespace
}  // namespace osteomill::bone_textures_test
