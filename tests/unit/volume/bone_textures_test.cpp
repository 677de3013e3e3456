#include "render_client/volume/bone_textures.h"

#include "tests/unit/volume/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill {
namespace {

using BoneTexturesTest = OffscreenTest;

const Grid grid{.size_voxels = {90, 70, 50}, .origin_mm = {0.05, 0.05, 0.05}};

Bone ball() {
    return made_bone(grid,
                     [](const glm::dvec3& p) { return 1.9 - glm::length(p - glm::dvec3(5.0, 4.0, 2.5)); });
}

std::vector<std::uint8_t> texels(const gl::Texture3D& texture) {
    std::vector<std::uint8_t> bytes(VoxelBox{{}, texture.size()}.count());
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

TEST_F(BoneTexturesTest, AreTheSameByDirtyBricksAsByAFullUpload) {
    Bone bone = ball();
    BoneTextures updated(bone, {});
    const auto dirty = carve_sphere(bone, {4.2, 3.5, 4.0}, 1.1);
    ASSERT_FALSE(dirty.empty());
    ASSERT_LT(dirty.size(), bone.stored_bricks());
    updated.update(bone, dirty);
    const BoneTextures uploaded(bone, {});
    EXPECT_EQ(texels(updated.fraction()), texels(uploaded.fraction()));
    EXPECT_EQ(texels(updated.mean_fraction()), texels(uploaded.mean_fraction()));
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

TEST_F(BoneTexturesTest, RefuseABoneThatExceedsTheDriversTextures) {
    const Grid wide{.size_voxels = {gl::max_texture3d_edge() + 16, 16, 16}};
    const double last_mm = wide.spacing_mm * (wide.size_voxels.x - 1);
    const Bone bone =
        made_bone(wide, [&](const glm::dvec3& p) { return p.x < 1.0 || p.x > last_mm - 1.0 ? 1.0 : -1.0; });
    EXPECT_THROW(BoneTextures(bone, {}), std::runtime_error);
}

TEST_F(BoneTexturesTest, RefuseABoneWithoutAnyVoxel) {
    const Bone bone = made_bone(grid, [](const glm::dvec3&) { return -1.0; });
    EXPECT_THROW(BoneTextures(bone, {}), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
