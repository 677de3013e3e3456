#include "render_client/volume/textures/voxel_codes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <random>

#include "common/bone/bone_builder.h"

namespace osteomill::voxel_codes_test {
namespace {

/// Two bricks side by side with stiffnesses and labels at random.
Bone random_bone() {
    const Grid grid{.size_voxels = {32, 16, 16}};
    BoneBuilder builder = BoneBuilder::heterogeneous(grid, 0.02, true);
    std::mt19937 random(11);
    for (int x = 0; x < 2; ++x) {
        ByteBrick fraction{}, stiffness{}, tissue{};
        fraction.fill(255);
        for (std::uint8_t& code : stiffness) code = static_cast<std::uint8_t>(1 + random() % 200);
        for (std::uint8_t& label : tissue) label = static_cast<std::uint8_t>(random() % 3);
        builder.add_brick({x, 0, 0}, fraction, &stiffness, &tissue);
    }
    return std::move(builder).build();
}

std::uint8_t stiffness_code(const Bone& bone, const glm::ivec3& voxel) {
    return static_cast<std::uint8_t>(std::lround(bone.stiffness_at(voxel) / 0.02));
}

/// Calls check(voxel, place) for the voxels of a box, in their order.
template <typename Check>
void for_each_voxel(const VoxelBox& box, Check check) {
    std::size_t place = 0;
    for (int z = 0; z < box.size.z; ++z)
        for (int y = 0; y < box.size.y; ++y)
            for (int x = 0; x < box.size.x; ++x) check(box.first + glm::ivec3(x, y, z), place++);
}

const VoxelBox past_the_grid{{-2, 3, -1}, {36, 9, 12}};

TEST(VoxelCodes, OfBothAreLookedUpByLabelAndStiffness) {
    const Bone bone = random_bone();
    VoxelCodes codes;
    EXPECT_FALSE(codes.exist());
    codes.by_tissue_and_stiffness.resize(std::size_t{256} * 256);
    for (std::size_t i = 0; i < codes.by_tissue_and_stiffness.size(); ++i)
        codes.by_tissue_and_stiffness[i] = static_cast<std::uint8_t>(i % 251);
    codes.by_tissue_and_stiffness[0] = 0;
    EXPECT_TRUE(codes.exist());
    EXPECT_TRUE(codes.are_mostly_alike());
    std::vector<std::uint8_t> found(past_the_grid.count());
    copy_codes(bone, codes, past_the_grid, found);
    for_each_voxel(past_the_grid, [&](const glm::ivec3& voxel, std::size_t place) {
        const std::size_t expected = 256 * bone.tissue_at(voxel) + stiffness_code(bone, voxel);
        ASSERT_EQ(found[place], expected % 251) << voxel.x << " " << voxel.y << " " << voxel.z;
    });
}

TEST(VoxelCodes, OfStiffnessCanBeTheStiffestNearby) {
    const Bone bone = random_bone();
    const VoxelCodes codes{.channel = BoneChannel::stiffness};
    EXPECT_FALSE(codes.are_mostly_alike());
    std::vector<std::uint8_t> found(past_the_grid.count());
    copy_stiffest_codes(bone, codes, past_the_grid, found);
    for_each_voxel(past_the_grid, [&](const glm::ivec3& voxel, std::size_t place) {
        std::uint8_t stiffest = 0;
        for_each_voxel({voxel - 1, glm::ivec3(3)}, [&](const glm::ivec3& near, std::size_t) {
            stiffest = std::max(stiffest, stiffness_code(bone, near));
        });
        ASSERT_EQ(found[place], stiffest) << voxel.x << " " << voxel.y << " " << voxel.z;
    });
}

TEST(VoxelCodes, OfLabelsAreTheVoxelsOwn) {
    const Bone bone = random_bone();
    const VoxelCodes codes{.channel = BoneChannel::tissue};
    std::vector<std::uint8_t> found(past_the_grid.count()), stiffest(past_the_grid.count());
    copy_codes(bone, codes, past_the_grid, found);
    copy_stiffest_codes(bone, codes, past_the_grid, stiffest);
    for_each_voxel(past_the_grid, [&](const glm::ivec3& voxel, std::size_t place) {
        ASSERT_EQ(found[place], bone.tissue_at(voxel));
        ASSERT_EQ(stiffest[place], bone.tissue_at(voxel));
    });
}

/// Two bricks of label 1, with a voxel of another label here and there, and air.
Bone bone_with_specks(int specks, std::uint32_t seed) {
    const Grid grid{.size_voxels = {32, 16, 16}};
    BoneBuilder builder = BoneBuilder::heterogeneous(grid, 0.02, true);
    std::mt19937 random(seed);
    for (int x = 0; x < 2; ++x) {
        ByteBrick fraction{}, stiffness{}, tissue{};
        fraction.fill(255);
        stiffness.fill(50);
        tissue.fill(1);
        for (int speck = 0; speck < specks; ++speck)
            tissue[random() % tissue.size()] = static_cast<std::uint8_t>(random() % 3);
        builder.add_brick({x, 0, 0}, fraction, &stiffness, &tissue);
    }
    return std::move(builder).build();
}

TEST(VoxelCodes, BlocksOfOneCodeHaveNoSecondOneWithinTwoVoxels) {
    const VoxelCodes codes{.channel = BoneChannel::tissue};
    int of_one_code = 0, others = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Bone bone = bone_with_specks(static_cast<int>(seed), seed);
        for (int brick = 0; brick < 2; ++brick) {
            const auto are_one = blocks_of_one_code(bone, codes, {brick, 0, 0});
            for (int block = 0; block < static_cast<int>(blocks_per_brick); ++block) {
                const glm::ivec3 first =
                    glm::ivec3(16 * brick, 0, 0) + 4 * glm::ivec3(block & 3, block >> 2 & 3, block >> 4);
                std::vector<std::uint8_t> about(512);
                copy_codes(bone, codes, {first - 2, glm::ivec3(8)}, about);
                std::erase(about, std::uint8_t{0});
                const bool is_one = std::ranges::adjacent_find(about, std::not_equal_to<>()) == about.end();
                ASSERT_EQ(are_one[static_cast<std::size_t>(block)], is_one)
                    << "seed " << seed << ", block " << block;
                ++(is_one ? of_one_code : others);
            }
        }
    }
    EXPECT_GT(of_one_code, 100);
    EXPECT_GT(others, 100);
}

}  // namespace
}  // namespace osteomill::voxel_codes_test
