#include "simulation/force_models/petersik_probe.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <stdexcept>

#include "tests/unit/force_models/contact_bench.h"

namespace osteomill::petersik_probe_test {
namespace {

using testing::ContactBench;
using testing::remove_where;
using testing::wide_block;

TEST(PetersikProbe, IsALinearSpringOnTheDepthOfItsDeepestPoint) {
    PetersikProbe law({.stiffness_n_per_mm = 3.0, .surface_points = 4096});
    ContactBench bench(wide_block());
    // Points of a lattice of 4096 are 0.14 mm apart: the lowest is less than 2 um above the pole.
    for (const double depth_mm : {0.1, 0.25, 0.5, 1.0})
        EXPECT_NEAR(bench.pressed(law, depth_mm).force_n.z, 3.0 * depth_mm, 3.0 * 0.003);
}

TEST(PetersikProbe, NeedsOnlyAFewHundredPointsForThat) {
    PetersikProbe few({.stiffness_n_per_mm = 2.0});
    ContactBench bench(wide_block());
    EXPECT_NEAR(glm::length(bench.pressed(few, 0.5).force_n), 1.0, 0.03);
}

TEST(PetersikProbe, FollowsTheNormalOfATiltedFaceBetterThanOnePoint) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1.0, 0.5, 2.0));
    Bone bone = wide_block();
    remove_where(bone, [&](const glm::dvec3& p) { return glm::dot(p, normal) > -1.0; });
    PetersikProbe law({.stiffness_n_per_mm = 2.0, .surface_points = 2048});
    ContactBench bench(std::move(bone));
    const glm::dvec3 force = bench.at(law, (2.5 - 0.4 - 1.0) * normal).force_n;
    EXPECT_GT(glm::dot(glm::normalize(force), normal), 0.999);
    EXPECT_NEAR(glm::length(force), 2.0 * 0.4, 2.0 * 0.1) << "the staircase of whole voxels is that rough";
}

TEST(PetersikProbe, RefusesPointsThatAreNoPairs) {
    for (const int count : {-2, 0, 1, 511})
        EXPECT_THROW(PetersikProbe({.surface_points = count}), std::invalid_argument) << count;
}

}  // namespace
}  // namespace osteomill::petersik_probe_test
