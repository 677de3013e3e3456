#include "render_client/volume/textures/texture_plan.h"

#include <gtest/gtest.h>

#include "render_client/volume/textures/coarse_bone.h"
#include "studies/render/made_bone.h"

namespace osteomill::texture_plan_test {
namespace {

constexpr std::size_t plenty = std::size_t{1} << 40;

/// Two small bricks far apart: a box of 40 x 1 x 1 bricks, of which two are stored.
Bone two_bricks() {
    const Grid grid{.size_voxels = {640, 16, 16}};
    return made_bone(grid, [](const glm::dvec3& p) { return p.x < 1.55 || p.x > 62.35 ? 1.0 : -1.0; });
}

TEST(TexturePlan, PrefersADenseTextureThenAnAtlasThenCoarserCopies) {
    const Bone bone = two_bricks();
    const auto plans =
        texture_plans(bone.content(), {1}, {.budget_bytes = plenty, .longest_edge_texels = 2048});
    ASSERT_EQ(plans.size(), 8U);
    EXPECT_EQ(plans[0].layout, BoneLayout::dense);
    EXPECT_EQ(plans[0].bytes, 640U * 16 * 16 + 2U * 162 * 6 * 6);
    EXPECT_EQ(plans[1].layout, BoneLayout::atlas);
    // Tiles of two bricks and the empty one, in a square of four; a table of 40; the same map.
    EXPECT_EQ(plans[1].bytes, 4U * 18 * 18 * 18 + 4U * 40 + 2U * 162 * 6 * 6);
    EXPECT_EQ(plans[1].coarsening, 1);
    EXPECT_EQ(plans[2].coarsening, 2);
    EXPECT_EQ(plans.back().coarsening, coarsest);
}

TEST(TexturePlan, KeepsToTheBudget) {
    const Bone bone = two_bricks();
    const TextureLimits limits{.budget_bytes = 50'000, .longest_edge_texels = 2048};
    const auto plans = texture_plans(bone.content(), {1}, limits);
    ASSERT_FALSE(plans.empty());
    EXPECT_EQ(plans.front().layout, BoneLayout::atlas);
    for (const TexturePlan& plan : plans) EXPECT_LE(plan.bytes, limits.budget_bytes);
}

TEST(TexturePlan, KeepsToTheLongestEdge) {
    const Bone bone = two_bricks();
    const auto plans =
        texture_plans(bone.content(), {1}, {.budget_bytes = plenty, .longest_edge_texels = 256});
    ASSERT_FALSE(plans.empty());
    EXPECT_EQ(plans.front().layout, BoneLayout::atlas);
    EXPECT_EQ(plans.front().coarsening, 1);
}

TEST(TexturePlan, HasSmoothedFractionsWithinHalfOfTheBudget) {
    const Bone bone = two_bricks();
    const auto plans = [&](std::size_t budget_bytes) {
        return texture_plans(bone.content(), {.needed = 1, .smoothed = 1},
                             {.budget_bytes = budget_bytes, .longest_edge_texels = 2048});
    };
    // Dense, both take 339'344 bytes; as an atlas, 58'480.
    EXPECT_EQ(plans(2 * 339'344)[0], (TexturePlan{BoneLayout::dense, 1, 339'344, true}));
    EXPECT_EQ(plans(2 * 339'343)[0], (TexturePlan{BoneLayout::atlas, 1, 58'480, true}));
    EXPECT_FALSE(plans(2 * 58'479)[0].smoothed);
    EXPECT_EQ(plans(2 * 58'479)[0].coarsening, 1) << "rather than coarser bone";
}

TEST(TexturePlan, HasNoneWhereNothingFits) {
    const Bone bone = two_bricks();
    EXPECT_TRUE(
        texture_plans(bone.content(), {1}, {.budget_bytes = 100, .longest_edge_texels = 2048}).empty());
}

TEST(TexturePlan, IsDescribedInOneLine) {
    EXPECT_EQ(description({BoneLayout::dense, 1, 21U << 20}), "a dense texture, 21 MiB");
    EXPECT_EQ(description({BoneLayout::atlas, 2, 412U << 20}),
              "a brick atlas, 412 MiB, of a copy 2 times coarser");
}

}  // namespace
}  // namespace osteomill::texture_plan_test
