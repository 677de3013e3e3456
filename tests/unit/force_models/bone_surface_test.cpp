#include "simulation/force_models/bone_surface.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/block.h"

namespace osteomill::bone_surface_test {
namespace {

using testing::make_block;

/// Voxel coordinates (0, 0, 0) to (32, 32, 16) are bone; the top face lies at z = 15.5.
class BoneSurfaceTest : public ::testing::Test {
  protected:
    BoneSurfaceTest() { bricks.gather(bone, centre, 8.0); }
    glm::vec3 position(const glm::vec3& voxel) const { return voxel - glm::vec3(bricks.base()); }

    Bone bone = make_block({0.0, 0.0, 0.0}, {3.2, 3.2, 1.6}, 0.1);
    BrickNeighbourhood bricks{8.0};
    glm::dvec3 centre{16.0, 16.0, 15.0};
};

TEST_F(BoneSurfaceTest, LiesOnTheFaceOfTheOutermostVoxels) {
    for (const float z : {15.4f, 15.0f, 14.6f, 13.2f})
        EXPECT_NEAR(length_in_bone(bricks, position({16.3f, 15.8f, z}), {0.0f, 0.0f, 1.0f}, 20.0f), 15.5f - z,
                    1e-3f);
}

TEST_F(BoneSurfaceTest, IsMetLaterByASlantedRay) {
    const glm::vec3 direction = glm::normalize(glm::vec3(1.0f, 0.0f, 1.0f));
    EXPECT_NEAR(length_in_bone(bricks, position({14.0f, 16.0f, 13.0f}), direction, 20.0f),
                2.5f * std::sqrt(2.0f), 0.02f);
}

TEST_F(BoneSurfaceTest, IsNotFoundBeyondTheLongestRay) {
    EXPECT_EQ(length_in_bone(bricks, position({16.0f, 16.0f, 12.0f}), {0.0f, 0.0f, 1.0f}, 3.0f), 3.0f);
    EXPECT_EQ(length_in_bone(bricks, position({16.0f, 16.0f, 15.4f}), {0.0f, 0.0f, 1.0f}, 0.0f), 0.0f);
}

TEST_F(BoneSurfaceTest, HasANormalOnlyNearIt) {
    EXPECT_NEAR(glm::distance(outward_normal(bricks, position({16.2f, 16.4f, 15.5f})), {0.0, 0.0, 1.0}), 0.0,
                1e-6);
    EXPECT_EQ(outward_normal(bricks, position({16.0f, 16.0f, 12.0f})), glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill::bone_surface_test
