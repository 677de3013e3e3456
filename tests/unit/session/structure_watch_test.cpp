#include "common/session/structure_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/ball_structure.h"

namespace osteomill {
namespace {

constexpr double voxel_edge_mm = 0.1;
constexpr double nerve_radius_mm = 1.5;  // radius of the nerve, about the origin
constexpr double burr_radius_mm = 1.0;   // radius of the burr

class StructureWatchTest : public ::testing::Test {
  protected:
    StructureWatchTest()
        : watch_({{1, testing::ball_mask(grid_, {0.0, 0.0, 0.0}, nerve_radius_mm)}},
                 {{.label = 1, .name = "bone"}, {.label = 2, .name = "nerve", .is_protected = true}},
                 {Burr{.name = "round", .diameter_mm = 2.0 * burr_radius_mm}}) {}

    const StructureDistance* at(const glm::dvec3& place_mm, double after_s = 0.1) {
        tool_.time_s += after_s;
        tool_.burr_position_mm = place_mm;
        watch_.update(tool_);
        return watch_.distances().empty() ? nullptr : &watch_.distances().front();
    }
    /// A voxel of the nerve's middle, milled to so much.
    void mill(std::uint8_t before, std::uint8_t after, ChangeKind kind = ChangeKind::milled) {
        const glm::ivec3 voxel = grid_.size_voxels / 2;
        const BrickChange change{brick_index(size_in_bricks(grid_), voxel / brick_edge_voxels),
                                 VoxelMask().set(offset_in_brick(voxel)), kind};
        ByteBrick were, are;
        were.fill(before);
        are.fill(after);
        watch_.note(change, were, are, nullptr);
    }

    Grid grid_{.size_voxels = {64, 64, 64}, .spacing_mm = voxel_edge_mm, .origin_mm = glm::dvec3(-3.15)};
    StructureWatch watch_;
    ToolState tool_;
};

TEST_F(StructureWatchTest, TellsTheDistanceFromABallToABallWithinHalfAVoxel) {
    std::mt19937 random(6);
    std::normal_distribution<double> part;
    double worst_mm = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 way = glm::normalize(glm::dvec3(part(random), part(random), part(random)));
        const double apart_mm = std::uniform_real_distribution<double>(0.1, 2.9)(random);
        const StructureDistance* found = at((nerve_radius_mm + burr_radius_mm + apart_mm) * way);
        ASSERT_TRUE(found != nullptr && found->distance_mm);
        EXPECT_EQ(found->tissue, 1u);
        EXPECT_FALSE(found->touches) << apart_mm;
        worst_mm = std::max(worst_mm, std::abs(*found->distance_mm - apart_mm));
    }
    // The ball is made of cubes: another half voxel at their corners.
    EXPECT_LT(worst_mm, voxel_edge_mm);
}

TEST_F(StructureWatchTest, SaysNothingOfWhatIsTooFarOff) {
    EXPECT_EQ(at({nerve_radius_mm + burr_radius_mm + 3.1, 0.0, 0.0}), nullptr);
    EXPECT_EQ(at({1e6, 0.0, 0.0}), nullptr);
    EXPECT_FALSE(watch_.accounts().front().nearest_mm);
    const StructureDistance* near = at({nerve_radius_mm + burr_radius_mm + 2.8, 0.0, 0.0});
    ASSERT_TRUE(near != nullptr && near->distance_mm);
    EXPECT_NEAR(*near->distance_mm, 2.8, 0.05);
    EXPECT_EQ(near->touches_so_far, 0u);
}

TEST_F(StructureWatchTest, CountsTouchesAndTheirTime) {
    const glm::dvec3 touching(0.0, 0.0, nerve_radius_mm + burr_radius_mm - 0.2);
    const glm::dvec3 away(0.0, 0.0, 9.0);
    at(away);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(at(touching)->touches);  // from 0.2 s on
    const StructureDistance* left = at(away);
    ASSERT_NE(left, nullptr) << "what was touched stays in the account";
    EXPECT_FALSE(left->distance_mm);
    EXPECT_FALSE(left->touches);
    EXPECT_NEAR(at(touching)->touched_s, 0.4, 1e-9) << "the same spell";
    EXPECT_EQ(at(touching)->touches_so_far, 1u);
    at(away, 0.6);
    const StructureDistance* again = at(touching);
    EXPECT_EQ(again->touches_so_far, 2u);
    EXPECT_NEAR(again->first_touch_s, 0.2, 1e-9);
    EXPECT_NEAR(*again->distance_mm, -0.2, 0.1);
    EXPECT_NEAR(*watch_.accounts().front().nearest_mm, -0.2, 0.1);
}

TEST_F(StructureWatchTest, CountsTheVolumeThatTheHeadEnteredOnce) {
    // Two balls that overlap: V = pi (R + r - d)^2 (d^2 + 2 d (r + R) - 3 (R - r)^2) / (12 d).
    const double d = 1.8;
    const double lens_mm3 = std::numbers::pi * std::pow(nerve_radius_mm + burr_radius_mm - d, 2) *
                            (d * d + 2.0 * d * (nerve_radius_mm + burr_radius_mm) -
                             3.0 * std::pow(nerve_radius_mm - burr_radius_mm, 2)) /
                            (12.0 * d);
    EXPECT_NEAR(at({d, 0.0, 0.0})->entered_mm3, lens_mm3, 0.05 * lens_mm3);
    EXPECT_NEAR(at({d, 0.0, 0.0})->entered_mm3, lens_mm3, 0.05 * lens_mm3) << "once";
    EXPECT_EQ(at({d, 0.0, 0.0})->removed_mm3, 0.0) << "no bone was there";
    EXPECT_NEAR(at({-d, 0.0, 0.0})->entered_mm3, 2.0 * lens_mm3, 0.1 * lens_mm3);
}

TEST_F(StructureWatchTest, TakesTheTrueHeadOfAnotherBurr) {
    Burr cylinder{.name = "cylinder", .diameter_mm = 2.0};
    cylinder.head = usual_head(HeadShape::cylinder, cylinder.diameter_mm, 6.0);
    StructureWatch watch({{0, testing::ball_mask(grid_, {0.0, 0.0, 0.0}, nerve_radius_mm)}},
                         {{.label = 2, .name = "nerve", .is_protected = true}}, {cylinder});
    // Its side passes the nerve 4 mm above the burr's centre, where its ball is far away.
    ToolState tool{.time_s = 0.1, .burr_position_mm = {nerve_radius_mm + 1.0 + 0.7, 0.0, -4.0}};
    watch.update(tool);
    ASSERT_EQ(watch.distances().size(), 1u);
    EXPECT_NEAR(*watch.distances()[0].distance_mm, 0.7, 0.08);
    EXPECT_EQ(watch.distances()[0].entered_mm3, 0.0);
    tool.burr_position_mm.x = nerve_radius_mm;
    watch.update(tool);
    EXPECT_GT(watch.distances()[0].entered_mm3, 1.0);
}

TEST_F(StructureWatchTest, CountsBoneOfItThatIsMilledAndGivenBack) {
    const double voxel_mm3 = voxel_edge_mm * voxel_edge_mm * voxel_edge_mm;
    const glm::dvec3 away(0.0, 0.0, 9.0);
    mill(255, 0);
    const StructureDistance* milled = at(away);
    ASSERT_NE(milled, nullptr);
    EXPECT_TRUE(milled->touches) << "between two states it was there";
    EXPECT_NEAR(milled->removed_mm3, voxel_mm3, 1e-12);
    EXPECT_EQ(watch_.accounts().front().nearest_mm, 0.0);
    EXPECT_FALSE(at(away)->touches);
    mill(0, 255, ChangeKind::restored);
    const StructureDistance* restored = at(away);
    EXPECT_FALSE(restored->touches);
    EXPECT_EQ(restored->touches_so_far, 1u);
    EXPECT_NEAR(restored->removed_mm3, 0.0, 1e-12);
    EXPECT_NEAR(watch_.accounts().front().given_back_mm3, voxel_mm3, 1e-12);
}

TEST_F(StructureWatchTest, CountsBoneThatBearsItsLabelThoughTheMaskEndsThere) {
    const glm::ivec3 corner(1, 1, 1);  // far from the mask
    const BrickChange change{brick_index(size_in_bricks(grid_), corner / brick_edge_voxels),
                             VoxelMask().set(offset_in_brick(corner)).set(0), ChangeKind::milled};
    ByteBrick were, labels;
    were.fill(51);
    labels.fill(1);
    labels[offset_in_brick(corner)] = 2;
    watch_.note(change, were, ByteBrick{}, &labels);
    EXPECT_NEAR(at({0.0, 0.0, 9.0})->removed_mm3, 0.2 * std::pow(voxel_edge_mm, 3), 1e-12);
}

TEST_F(StructureWatchTest, TakesNoNoticeOfWhereTheSceneBegins) {
    watch_.update({.time_s = 0.0, .burr_position_mm = {0.0, 0.0, 0.0}});
    EXPECT_TRUE(watch_.distances().empty());
    EXPECT_EQ(at({0.0, 0.0, 9.0}), nullptr);
    EXPECT_FALSE(watch_.accounts().front().nearest_mm);
}

TEST(StructureWatchOfNothing, CostsNothing) {
    StructureWatch watch;
    watch.update({});
    EXPECT_TRUE(watch.empty());
    EXPECT_TRUE(watch.distances().empty());
    EXPECT_EQ(watch.memory_bytes(), 0u);
}

}  // namespace
}  // namespace osteomill
