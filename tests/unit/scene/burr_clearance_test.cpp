#include "common/scene/burr_clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "common/scene/burr_profile.h"

namespace osteomill {
namespace {

constexpr double spacing_mm = 0.1;

/// A few single voxels, far apart.
struct Specks {
    Grid grid{.size_voxels = {96, 96, 96}, .spacing_mm = spacing_mm, .origin_mm = {-5.0, -5.0, -5.0}};
    std::vector<glm::dvec3> centres_mm;
    StructureMask mask;

    explicit Specks(const std::vector<glm::ivec3>& voxels) {
        std::vector<VoxelMask> masks(6 * 6 * 6);
        for (const glm::ivec3& voxel : voxels) {
            masks[brick_index({6, 6, 6}, voxel / brick_edge_voxels)].set(offset_in_brick(voxel));
            centres_mm.push_back(centre_of_voxel_mm(grid, voxel));
        }
        std::vector<StructureBrick> bricks;
        for (BrickIndex brick = 0; brick < masks.size(); ++brick) bricks.push_back({brick, masks[brick]});
        mask = StructureMask(grid, std::move(bricks));
    }
};

TEST(BurrClearance, OfABallIsTheDistanceOfItsCentreLessItsRadius) {
    const Specks specks({{50, 50, 50}});
    const DistanceField field(specks.mask, 4.0);
    const BurrClearance clearance(Burr{.name = "ball", .diameter_mm = 2.0});
    const glm::dvec3 middle_mm = specks.centres_mm[0];
    EXPECT_NEAR(*clearance.clearance_mm(field, {middle_mm + glm::dvec3(3.0, 0.0, 0.0)}), 1.95, 1e-5);
    EXPECT_NEAR(*clearance.clearance_mm(field, {middle_mm + glm::dvec3(0.0, -0.75, 0.0)}), -0.3, 1e-5);
    EXPECT_NEAR(*clearance.clearance_mm(field, {middle_mm}), -1.0, 1e-5);
    EXPECT_FALSE(clearance.clearance_mm(field, {middle_mm + glm::dvec3(0.0, 0.0, 4.2)}));
}

// A speck is nearly a point: its distance from the head is the profile's at the speck.
TEST(BurrClearance, OfEveryHeadIsThatOfItsProfile) {
    const Specks specks({{20, 30, 40}, {70, 60, 50}});
    const DistanceField field(specks.mask, 8.0);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    for (const HeadShape shape : {HeadShape::cylinder, HeadShape::cone, HeadShape::barrel, HeadShape::pear}) {
        Burr burr{.name = "head", .diameter_mm = 2.4};
        burr.head = usual_head(shape, burr.diameter_mm, 5.0);
        const BurrClearance clearance(burr);
        const BurrProfile profile(burr.head, burr.diameter_mm);
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 axis =
                glm::normalize(glm::dvec3(part(random), part(random), part(random)) + 1e-3);
            const ToolPose pose{4.0 * glm::dvec3(part(random), part(random), part(random)), axis};
            double expected_mm = 1e9;
            for (const glm::dvec3& speck_mm : specks.centres_mm) {
                const glm::dvec3 apart_mm = speck_mm - pose.position_mm;
                const double height_mm = glm::dot(apart_mm, axis);
                const double radius_mm = glm::length(apart_mm - height_mm * axis);
                expected_mm = std::min(expected_mm, profile.nearest(radius_mm, height_mm).distance);
            }
            const std::optional<double> found_mm = clearance.clearance_mm(field, pose);
            ASSERT_TRUE(found_mm);
            // Half a voxel for the field, up to the cube's half diagonal for the speck's size, a third of a
            // step for the samples. Inside, only the touch is as exact.
            if (expected_mm > 0.2) {
                EXPECT_NEAR(*found_mm, expected_mm, 0.05 + 0.087 + 0.08) << static_cast<int>(shape);
            } else if (expected_mm < -0.2) {
                EXPECT_LE(*found_mm, 0.0) << static_cast<int>(shape);
            }
        }
    }
}

}  // namespace
}  // namespace osteomill
