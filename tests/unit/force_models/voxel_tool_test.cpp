#include "simulation/force_models/voxel_tool.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "tests/unit/force_models/contact_bench.h"

namespace osteomill::voxel_tool_test {
namespace {

using testing::ContactBench;
using testing::wide_block;

double cap_mm3(double depth_mm, double radius_mm) {
    return std::numbers::pi * depth_mm * depth_mm * (radius_mm - depth_mm / 3.0);
}

TEST(VoxelTool, GrowsWithTheVolumeOfBoneWithinTheBurr) {
    VoxelTool law({.stiffness_n_per_mm3 = 0.7});
    ContactBench bench(wide_block());
    for (const double depth_mm : {0.3, 0.5, 0.75, 1.0}) {
        const double expected_n = 0.7 * cap_mm3(depth_mm, 2.5);
        EXPECT_NEAR(glm::length(bench.pressed(law, depth_mm).force_n), expected_n, 0.01 * expected_n)
            << depth_mm << " mm deep";
    }
}

TEST(VoxelTool, DoesNotDependOnTheSizeOfVoxels) {
    VoxelTool law;
    ContactBench coarse(testing::make_block({-2.4, -2.4, -1.6}, {2.4, 2.4, 0.0}, 0.2));
    ContactBench fine(testing::make_block({-2.4, -2.4, -1.6}, {2.4, 2.4, 0.0}, 0.1));
    const double fine_n = glm::length(fine.pressed(law, 0.6).force_n);
    EXPECT_NEAR(glm::length(coarse.pressed(law, 0.6).force_n), fine_n, 0.02 * fine_n);
}

TEST(VoxelTool, FeelsAFifthOfABoneOfWhichAFifthIsLeft) {
    Bone worn = wide_block();
    for (std::size_t slot = 0; slot < worn.stored_bricks(); ++slot)
        for (std::uint8_t& fraction : worn.fractions(static_cast<std::int32_t>(slot)))
            fraction = static_cast<std::uint8_t>(fraction == 255 ? 51 : 0);
    VoxelTool law;
    ContactBench whole(wide_block());
    ContactBench fifth(std::move(worn));
    EXPECT_NEAR(fifth.pressed(law, 0.5).force_n.z, 0.2 * whole.pressed(law, 0.5).force_n.z, 1e-9);
}

}  // namespace
}  // namespace osteomill::voxel_tool_test
