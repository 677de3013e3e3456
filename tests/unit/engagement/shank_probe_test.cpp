#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "simulation/engagement/engagement_probe.h"
#include "tests/support/block.h"

namespace osteomill::shank_probe_test {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

Burr burr_with(const ShankProfile& shank) {
    return {.name = "2 mm", .diameter_mm = 2.0, .shank = shank};
}

std::unique_ptr<Engagement> sampled(const ShankProfile& shank, const Bone& bone,
                                    const glm::dvec3& position_mm, const glm::dvec3& axis = up) {
    auto engagement = std::make_unique<Engagement>();
    engagement->shank_count = 7;  // from an older step
    ShankProbe(burr_with(shank)).sample(bone, position_mm, axis, *engagement);
    return engagement;
}

double area_mm2(const Engagement& engagement) {
    double area = 0.0;
    for (std::size_t i = 0; i < engagement.shank_count; ++i) area += engagement.shank_patches[i].area_mm2;
    return area;
}

TEST(ShankProbe, FindsNothingInAirNorWithoutAShank) {
    const Bone bone = testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 4.0}, 0.1);
    const ShankProfile shank{{1.2, 0.4}, {10.0, 0.4}};
    for (const glm::dvec3 position : {glm::dvec3(0, 0, 4.0), glm::dvec3(4.6, 0, 0), glm::dvec3(0, -1e9, 0)})
        EXPECT_EQ(sampled(shank, bone, position)->shank_count, 0U);
    EXPECT_EQ(sampled({}, bone, glm::dvec3(0.0))->shank_count, 0U);
}

TEST(ShankProbe, CoversTheShankOutsideTheBurr) {
    const Bone bone = testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 16.0}, 0.1);
    const auto cylinder = sampled({{1.2, 0.5}, {11.2, 0.5}}, bone, glm::dvec3(0.0));
    EXPECT_NEAR(area_mm2(*cylinder), 2.0 * std::numbers::pi * 0.5 * 10.0, 1e-9);
    for (std::size_t i = 0; i < cylinder->shank_count; ++i) {
        EXPECT_NEAR(cylinder->shank_patches[i].normal.z, 0.0, 1e-12);
        EXPECT_NEAR(cylinder->shank_patches[i].gap_mm, -0.15, 1e-6) << "as deep as the map looks";
    }
    // A cone from 0.5 to 1.5 mm over 10 mm, its slant by its mean circumference.
    const auto cone = sampled({{1.2, 0.5}, {11.2, 1.5}}, bone, glm::dvec3(0.0));
    EXPECT_NEAR(area_mm2(*cone), 2.0 * std::numbers::pi * 1.0 * std::hypot(10.0, 1.0), 0.02 * 60.0);
    for (std::size_t i = 0; i < cone->shank_count; ++i)
        EXPECT_NEAR(cone->shank_patches[i].normal.z, -1.0 / std::hypot(10.0, 1.0), 1e-12);
    // A neck that begins within the ball: only the part outside is sampled.
    const auto neck = sampled({{0.5, 0.3}, {8.0, 0.3}}, bone, glm::dvec3(0.0));
    EXPECT_LT(neck->shank_count, Engagement::max_shank_patches);
    for (std::size_t i = 0; i < neck->shank_count; ++i)
        EXPECT_GE(glm::length(neck->shank_patches[i].arm_mm), 1.0);
}

TEST(ShankProbe, IsDenserNearTheBurrAndMissesNoShoulder) {
    const Bone bone = testing::make_block({-8.0, -8.0, -2.0}, {8.0, 8.0, 30.0}, 0.2);
    const auto map = sampled({{1.2, 0.4}, {10.0, 0.4}, {10.1, 5.0}, {25.0, 5.0}}, bone, glm::dvec3(0.0));
    ASSERT_EQ(map->shank_count, Engagement::max_shank_patches);
    int below_four_mm = 0;
    int shoulder = 0;
    for (std::size_t i = 0; i < map->shank_count; ++i) {
        below_four_mm += map->shank_patches[i].arm_mm.z < 4.0;
        shoulder += map->shank_patches[i].normal.z < -0.9;
    }
    EXPECT_GE(below_four_mm, 24);
    EXPECT_EQ(shoulder, ShankProbe::samples_a_ring);
}

TEST(ShankProbe, GapIsTheDistanceToAWall) {
    // Bone beyond x = 0.5, a shank of 0.4 mm on its way to it.
    const Bone bone = testing::make_block({0.5, -4.0, -4.0}, {4.0, 4.0, 16.0}, 0.1);
    for (const double gap_mm : {0.08, 0.03, -0.05}) {
        const auto map = sampled({{1.2, 0.4}, {11.2, 0.4}}, bone, {0.1 - gap_mm, 0.013, 0.017});
        int facing = 0;
        for (std::size_t i = 0; i < map->shank_count; ++i) {
            const ShankPatch& patch = map->shank_patches[i];
            EXPECT_GT(patch.normal.x, 0.0);
            if (patch.normal.x < 0.999) continue;
            ++facing;
            EXPECT_NEAR(patch.gap_mm, gap_mm, 0.01);
            EXPECT_NEAR(patch.arm_mm.x, 0.4, 1e-12);
            EXPECT_GT(patch.arm_mm.z, 1.2);
        }
        EXPECT_EQ(facing, ShankProbe::rings / 2) << "every other ring is turned";
    }
}

TEST(ShankProbe, DoesNotTakeTheBoneOfOneSideForTheOthers) {
    // A neck thinner than the map looks deep, hard by a wall on its left.
    const Bone bone = testing::make_block({-8.0, -8.0, -4.0}, {0.0, 8.0, 16.0}, 0.4);
    const auto map = sampled({{1.2, 0.3}, {11.2, 0.3}}, bone, {0.25, 0.0, 0.0});
    ASSERT_GT(map->shank_count, 0U);
    for (std::size_t i = 0; i < map->shank_count; ++i) EXPECT_LT(map->shank_patches[i].normal.x, 0.1);
}

TEST(ShankProbe, TurnsWithTheSpindle) {
    // The shank lies along x, above flat bone.
    const Bone bone = testing::make_block({-4.0, -4.0, -3.0}, {16.0, 4.0, 0.0}, 0.1);
    const auto map = sampled({{1.2, 0.4}, {11.2, 0.4}}, bone, {0.0, 0.0, 0.42}, {1.0, 0.0, 0.0});
    ASSERT_GT(map->shank_count, 0U);
    for (std::size_t i = 0; i < map->shank_count; ++i) {
        EXPECT_LT(map->shank_patches[i].normal.z, 0.0);
        EXPECT_NEAR(map->shank_patches[i].normal.x, 0.0, 1e-12);
        EXPECT_GT(map->shank_patches[i].arm_mm.x, 1.2);
    }
}

}  // namespace
}  // namespace osteomill::shank_probe_test
