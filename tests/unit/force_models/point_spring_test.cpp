#include "simulation/force_models/point_spring.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/unit/force_models/contact_bench.h"

namespace osteomill::point_spring_test {
namespace {

using testing::ContactBench;
using testing::remove_where;
using testing::wide_block;

TEST(PointSpring, IsALinearSpringOnTheDepth) {
    PointSpring law({.stiffness_n_per_mm = 3.0});
    ContactBench bench(wide_block());
    for (const double depth_mm : {0.013, 0.1, 0.25, 0.5, 1.0})
        EXPECT_NEAR(bench.pressed(law, depth_mm).force_n.z, 3.0 * depth_mm, 3.0 * 1e-4);
}

TEST(PointSpring, HasTheSurfaceWherePartialVoxelsPutIt) {
    Bone bone = wide_block();
    // The top layer, z from -0.1 to 0, is half there: the surface lies near its middle.
    const glm::ivec3 size = bone.grid().size_voxels;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec3 voxel(x, y, size.z - 1);
            bone.fractions(bone.slot(voxel >> 4))[offset_in_brick(voxel)] = 128;
        }
    PointSpring law({.stiffness_n_per_mm = 2.0});
    ContactBench bench(std::move(bone));
    EXPECT_NEAR(bench.pressed(law, 0.3).force_n.z, 2.0 * 0.25, 2.0 * 0.002);
}

TEST(PointSpring, FollowsTheNormalOfATiltedFace) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1.0, 0.5, 2.0));
    Bone bone = wide_block();
    remove_where(bone, [&](const glm::dvec3& p) { return glm::dot(p, normal) > -1.0; });
    PointSpring law({.stiffness_n_per_mm = 2.0});
    ContactBench bench(std::move(bone));
    const glm::dvec3 force = bench.at(law, (2.5 - 0.4 - 1.0) * normal).force_n;
    // The staircase of whole voxels tells the normal to a few degrees, the depth to half a voxel.
    EXPECT_GT(glm::dot(glm::normalize(force), normal), 0.95);
    EXPECT_NEAR(glm::length(force), 2.0 * 0.4, 2.0 * 0.1);
}

TEST(PointSpring, LosesItsDirectionOnceItsCentreLiesDeepInBone) {
    PointSpring law;
    ContactBench bench(wide_block(), {.name = "1 mm", .diameter_mm = 1.0});
    EXPECT_GT(bench.pressed(law, 0.45).force_n.z, 0.8);
    EXPECT_EQ(bench.pressed(law, 1.0).force_n, glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill::point_spring_test
