#include "simulation/cutting_force/binned_force.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/removed_voxel.h"
#include "tests/support/steady_motion.h"

namespace osteomill::binned_force_test {
namespace {

using testing::ReferenceCase;

TEST(BinnedForce, ThicknessIsTheFeedPerToothWhereTheSlotIsFullest) {
    // A burr that advances by f in dt cuts chips of f / (N_phi n_rev dt) straight ahead at its equator.
    Burr burr;
    burr.edges = 4;
    burr.spindle_rev_per_s = 250.0;
    const ChipBins bins{.psi = 36, .z = 10};
    BinnedForce chips(bins);
    chips.begin_step(burr, CuttingStep(burr, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 0.1, 0.01));
    // Slice 5 reaches from z = 0 to 0.5 mm; its middle has r = 2.4875 mm. Fill bin 0 (psi 0 to 10 degrees)
    // 0.06 mm thick.
    const double r = std::sqrt(2.5 * 2.5 - 0.25 * 0.25);
    const double volume_mm3 = 0.06 * r * (2.0 * std::numbers::pi / 36.0) * 0.5;
    testing::add_voxel(chips, {24, 2, 3}, volume_mm3 / 0.001);
    EXPECT_NEAR(chips.chip_thickness_mm(0, 5), 0.06 / 10.0, 1e-9);
    EXPECT_EQ(chips.chip_thickness_mm(1, 5), 0.0);
}

TEST(BinnedForce, PublishedSumOverBinsComesNearTheReference) {
    for (const ReferenceCase& c : testing::reference_cases()) {
        // Bins are too coarse for a shallow cap, a thin shaving or the tip; the sum over voxels is not.
        if (c.depth_mm < 1.0 || c.previous_groove_mm_higher || c.velocity_mm_per_s.z != 0.0) continue;
        const auto binned = testing::run_steady(c, 0.1, 0.01, 2.0, {.summation = ForceSummation::bins});
        EXPECT_LT(testing::relative_error(binned.mean_force_n, c.mean_force_n), 0.03) << c.name;
    }
}

TEST(BinnedForce, RefusesNoBins) {
    EXPECT_THROW(BinnedForce({.psi = 0, .z = 4}), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::binned_force_test
