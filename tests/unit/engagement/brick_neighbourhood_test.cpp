#include "simulation/engagement/brick_neighbourhood.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <random>

#include "tests/support/speckled_bone.h"

namespace osteomill::brick_neighbourhood_test {
namespace {

/// Trilinear between voxel centres, one lookup in the bone for each.
double fraction_by_lookups(const Bone& bone, const glm::dvec3& at) {
    const glm::dvec3 base = glm::floor(at);
    double sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 corner(i & 1, (i >> 1) & 1, i >> 2);
        const glm::dvec3 weight = glm::mix(1.0 - (at - base), at - base, glm::dvec3(corner));
        sum += weight.x * weight.y * weight.z * bone.fraction_at(glm::ivec3(base) + corner);
    }
    return sum;
}

TEST(BrickNeighbourhood, SamplesWhatTheBoneHoldsInsideAndOutsideTheGrid) {
    std::mt19937 filling(5);
    const Bone bone = testing::make_speckled_bone(filling);
    std::mt19937 random(2);
    const glm::dvec3 size(bone.grid().size_voxels);
    std::uniform_real_distribution<double> share(-0.2, 1.2);
    std::uniform_real_distribution<double> offset(-5.0, 5.0);
    BrickNeighbourhood bricks(10.0);
    int compared = 0;
    for (int ball = 0; ball < 200; ++ball) {
        const glm::dvec3 centre = size * glm::dvec3(share(random), share(random), share(random));
        if (!bricks.gather(bone, centre, 10.0)) continue;
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 at = centre + glm::dvec3(offset(random), offset(random), offset(random));
            const glm::vec3 position(at - glm::dvec3(bricks.base()));
            EXPECT_NEAR(bricks.fraction(position), fraction_by_lookups(bone, at), 0.01);
            const glm::ivec3 nearest = bricks.base() + glm::ivec3(position + 0.5f);
            // Past the grid's edge a stored brick may hold any value: there is no bone.
            if (contains(bone.grid(), nearest)) {
                EXPECT_EQ(bricks.stiffness(position), bone.stiffness_at(nearest));
            }
            ++compared;
        }
    }
    EXPECT_GT(compared, 1000);
}

TEST(BrickNeighbourhood, SaysWhereThereIsNothing) {
    std::mt19937 filling(5);
    const Bone bone = testing::make_speckled_bone(filling);
    BrickNeighbourhood bricks(10.0);
    EXPECT_FALSE(bricks.gather(bone, {1e12, 0.0, 0.0}, 10.0));
    EXPECT_FALSE(bricks.gather(bone, {-11.0, 5.0, 5.0}, 10.0));
}

}  // namespace
}  // namespace osteomill::brick_neighbourhood_test
