#include "haptic_server/streaming/sweep_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {
namespace {

constexpr double radius = 25.0;

/// The voxels that a ball leaves in part, ahead of a motion along -z.
std::vector<PartVoxel> cut_by(const glm::dvec3& centre) {
    std::vector<PartVoxel> voxels;
    for (int z = 0; z < 30; ++z)
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 60; ++x) {
                const double left = 0.5 + glm::distance(glm::dvec3(x, y, z), centre) - radius;
                const auto steps = static_cast<int>(std::floor(255.0 * left + 0.5));
                if (steps > 0 && steps < 255)
                    voxels.push_back({glm::dvec3(x, y, z), static_cast<std::uint8_t>(steps)});
            }
    return voxels;
}

TEST(SweepFit, FindsWhereTheBurrIsToAThousandthOfAVoxel) {
    const glm::dvec3 from(30.0, 30.0, 32.5), end(30.21, 29.87, 30.4);
    const glm::dvec3 found = fit_end_of_sweep(from, end + glm::dvec3(0.3, -0.2, 0.25), radius, cut_by(end));
    EXPECT_LT(glm::distance(found, end), 1e-3);
}

TEST(SweepFit, KeepsToItsEstimateWhereTheVoxelsTellNothing) {
    const glm::dvec3 from(30.0, 30.0, 32.5), estimate(30.0, 30.0, 31.0);
    EXPECT_EQ(fit_end_of_sweep(from, estimate, radius, {}), estimate);
    EXPECT_EQ(fit_end_of_sweep(from, estimate, radius, cut_by({30.0, 30.0, 20.0})), estimate);
}

}  // namespace
}  // namespace osteomill
