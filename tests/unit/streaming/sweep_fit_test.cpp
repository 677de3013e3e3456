#include "haptic_server/streaming/sweep_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/smoothed_ramp.h"

namespace osteomill {
namespace {

constexpr double radius = 25.0;

/// The voxels that a ball leaves in part, ahead of a motion along -z.
std::vector<PartVoxel> cut_by(const glm::dvec3& centre, double smoothing) {
    std::vector<PartVoxel> voxels;
    for (int z = 0; z < 30; ++z)
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 60; ++x) {
                const double left =
                    testing::left_by_ramp(glm::distance(glm::dvec3(x, y, z), centre) - radius, smoothing);
                const auto steps = static_cast<int>(std::floor(255.0 * left + 0.5));
                if (steps > 0 && steps < 255)
                    voxels.push_back({glm::dvec3(x, y, z), static_cast<std::uint8_t>(steps)});
            }
    return voxels;
}

TEST(SweepFit, FindsWhereTheBurrIsToAThousandthOfAVoxel) {
    const glm::dvec3 from(30.0, 30.0, 32.5), end(30.21, 29.87, 30.4);
    for (const double smoothing : {0.0, 0.1, std::sqrt(0.5), 1.0}) {
        const glm::dvec3 found = fit_end_of_sweep(from, end + glm::dvec3(0.3, -0.2, 0.25), radius, smoothing,
                                                  cut_by(end, smoothing));
        EXPECT_LT(glm::distance(found, end), 1e-3) << smoothing;
    }
}

TEST(SweepFit, KeepsToItsEstimateWhereTheVoxelsTellNothing) {
    const glm::dvec3 from(30.0, 30.0, 32.5), estimate(30.0, 30.0, 31.0);
    EXPECT_EQ(fit_end_of_sweep(from, estimate, radius, 0.0, {}), estimate);
    EXPECT_EQ(fit_end_of_sweep(from, estimate, radius, 0.0, cut_by({30.0, 30.0, 20.0}, 0.0)), estimate);
    // Where the ramp is as good as flat, many voxels say less than a few in its middle.
    const std::vector<PartVoxel> at_its_end(100, PartVoxel{glm::dvec3(30.0, 30.0, 5.0), 254});
    EXPECT_EQ(fit_end_of_sweep(from, estimate, radius, 1.0, at_its_end), estimate);
    EXPECT_NE(fit_end_of_sweep(from, estimate, radius, 0.0, at_its_end), estimate);
}

}  // namespace
}  // namespace osteomill
