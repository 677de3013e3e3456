#include "tests/support/full_scan.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <stdexcept>

#include "studies/force/bone_block.h"
#include "studies/force/force_series.h"

namespace osteomill::study {
namespace {

const Burr burr{.diameter_mm = 1.5, .sense = SpindleSense::clockwise};

Bone layered_block() {
    return voxelised({.low_mm = {-2.0, -1.6, -1.8},
                      .high_mm = {2.0, 1.6, 0.4},
                      .up = glm::normalize(glm::dvec3(0.1, 0.2, 1.0)),
                      .layer = TopLayer{.thickness_mm = 0.5, .stiffness = 0.4}},
                     0.1);
}

/// Both models along a path that turns, dives, leaves the block and makes a long leap.
void expect_equal(const MillingSettings& settings) {
    const auto crescent = voxel_model(settings)(layered_block(), burr);
    const auto scan = full_scan_model(settings)(layered_block(), burr);
    const std::uint64_t untouched = checksum(scan->bone());
    glm::dvec3 place(-1.3, -0.7, 0.45);
    double total_n = 0.0;
    constexpr int leap = 55;
    for (int i = 0; i < 60; ++i) {
        if (i == leap) place += glm::dvec3(0.4, -0.6, 0.1);
        place += 0.06 * glm::normalize(glm::dvec3(1.0, 0.04 * i, i < 20 ? -0.5 : 0.2));
        const BurrCommand command{.pose = {place, glm::normalize(glm::dvec3(0.3, -0.2, 1.0))},
                                  .spindle_on = i != 10,
                                  .burr = 0,
                                  .elapsed_s = 0.01};
        const StepOutcome a = crescent->step(command);
        const StepOutcome b = scan->step(command);
        ASSERT_EQ(checksum(crescent->bone()), checksum(scan->bone())) << "step " << i;
        EXPECT_NEAR(a.removed_mm3, b.removed_mm3, 1e-9) << "step " << i;
        total_n += glm::length(b.force_n);
        // The scan takes the directions of a step as long as the burr from one middle only.
        if (i == leap) continue;
        EXPECT_LT(glm::length(a.force_n - b.force_n), 1e-4 * glm::length(b.force_n) + 1e-9) << "step " << i;
    }
    EXPECT_NE(checksum(scan->bone()), untouched);
    EXPECT_GT(total_n, 1.0);
}

TEST(FullScan, LeavesTheSameBoneAndFeelsTheSameForceAsTheCrescent) {
    expect_equal({});
    expect_equal({.coverage = VoxelCoverage::linear});
    expect_equal({.coverage = VoxelCoverage::binary});
    expect_equal({.summation = ForceSummation::bins});
}

TEST(FullScan, VisitsTheVoxelsOfTheTool) {
    // 4/3 pi 25^3 = 65 450, less or more by a share of the surface's voxels.
    EXPECT_NEAR(static_cast<double>(tool_voxel_count(Burr{.diameter_mm = 5.0}, 0.1)), 65'450.0, 400.0);
}

TEST(FullScan, KnowsNoInstants) {
    const MakeModel make = full_scan_model({.summation = ForceSummation::instants});
    EXPECT_THROW(make(layered_block(), burr), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study
