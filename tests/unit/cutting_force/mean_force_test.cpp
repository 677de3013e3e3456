#include "simulation/cutting_force/mean_force.h"

#include <gtest/gtest.h>

#include "studies/force/steady_run.h"
#include "tests/support/removed_voxel.h"
#include "tests/support/steady_motion.h"
#include "tests/support/studied_motion.h"

namespace osteomill::mean_force_test {
namespace {

using testing::ReferenceCase;
using testing::relative_error;
using testing::run_steady;
using testing::SteadyResult;

class AgainstReference : public ::testing::TestWithParam<ReferenceCase> {};

// Vector error over vector norm, averaged over 2 mm of travel, 0.1 mm voxels, at the published 100 Hz.
TEST_P(AgainstReference, MeanForceAndRemovalAgree) {
    const ReferenceCase& c = GetParam();
    const SteadyResult voxels = run_steady(c, 0.1, 0.01, 2.0);
    const double force_error = relative_error(voxels.mean_force_n, c.mean_force_n);
    RecordProperty("force_error_percent", std::to_string(100.0 * force_error));
    const bool upright_and_deep = c.burr.diameter_mm == 5.0 && c.spindle_axis.z == 1.0 && c.depth_mm > 0.3 &&
                                  c.velocity_mm_per_s.z == 0.0 && !c.previous_groove_mm_higher;
    EXPECT_LT(force_error, upright_and_deep ? 0.01 : 0.02)
        << "force " << voxels.mean_force_n.x << ' ' << voxels.mean_force_n.y << ' ' << voxels.mean_force_n.z;
    EXPECT_NEAR(voxels.removal_mm3_per_s / c.removal_mm3_per_s, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(SteadyMotions, AgainstReference, ::testing::ValuesIn(testing::reference_cases()),
                         [](const auto& test) {
                             std::string name = test.param.name;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

ReferenceCase slot_1_mm_deep() {
    for (const ReferenceCase& c : testing::reference_cases())
        if (c.name == "polish upright d=1.0") return c;
    throw std::runtime_error("no such case");
}

TEST(MeanForce, TangentialPowerIsKtTimesRemovalRate) {
    // One voxel's worth of bone on the burr's surface: power = F . e_psi * 2 pi r n_rev = K_t V / dt,
    // wherever it lay.
    Burr burr;
    burr.sense = SpindleSense::counter_clockwise;
    burr.cutting_coefficients_n_per_mm2 = {230.0, 0.0, 0.0};
    for (const glm::ivec3 voxel : {glm::ivec3(20, 0, -15), glm::ivec3(0, 7, -24), glm::ivec3(12, -9, 20)}) {
        MeanForce force(CuttingStep(burr, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 0.1, 0.01),
                        InstructionSet::plain);
        testing::add_voxel(force, voxel, 1.0);
        const double r_mm = 0.1 * std::hypot(voxel.x, voxel.y);
        const glm::dvec3 e_psi = glm::normalize(glm::dvec3(-voxel.y, voxel.x, 0.0));
        const double power_mj_per_s =
            -glm::dot(force.force_n(), e_psi) * 2.0 * 3.14159265358979 * r_mm * burr.spindle_rev_per_s;
        EXPECT_NEAR(power_mj_per_s, 230.0 * 0.001 / 0.01, 1e-4);
    }
}

TEST(MeanForce, IsProportionalToFeedAndToTheInverseOfSpindleSpeed) {
    ReferenceCase c = slot_1_mm_deep();
    const glm::dvec3 force = run_steady(c, 0.1, 0.01, 2.0).mean_force_n;
    ReferenceCase faster_feed = c;
    faster_feed.velocity_mm_per_s *= 2.0;
    EXPECT_LT(relative_error(run_steady(faster_feed, 0.1, 0.005, 2.0).mean_force_n, 2.0 * force), 0.01);
    ReferenceCase faster_spindle = c;
    faster_spindle.burr.spindle_rev_per_s *= 4.0;
    EXPECT_LT(relative_error(run_steady(faster_spindle, 0.1, 0.01, 2.0).mean_force_n, 0.25 * force), 1e-12);
}

TEST(MeanForce, MeanAndRemovalDoNotDependOnTheTickRateNorOnTheNumberOfEdges) {
    ReferenceCase c = slot_1_mm_deep();
    const SteadyResult at_100_hz = run_steady(c, 0.1, 0.01, 2.0);
    for (const double step_s : {0.002, 0.001, 0.0001}) {
        const SteadyResult other = run_steady(c, 0.1, step_s, 2.0);
        EXPECT_LT(relative_error(other.mean_force_n, at_100_hz.mean_force_n), 0.01) << step_s << " s";
        EXPECT_NEAR(other.removal_mm3_per_s / at_100_hz.removal_mm3_per_s, 1.0, 0.001) << step_s << " s";
    }
    c.burr.edges = 12;
    EXPECT_LT(relative_error(run_steady(c, 0.1, 0.01, 2.0).mean_force_n, at_100_hz.mean_force_n), 1e-12);
}

TEST(MeanForce, TakesEachLayersShareAndFollowsACurvedPath) {
    // Polishing, tilted, plunging, an arc, and a block whose upper 0.8 mm are softer.
    for (const study::StudiedMotion& motion : study::studied_motions(true)) {
        const auto series = study::run_motion(motion, {}, study::voxel_model());
        EXPECT_LT(relative_error(study::mean_force_n(series), motion.reference_n), 0.01) << motion.name;
    }
}

TEST(MeanForce, ErrsLessTheFinerTheVoxels) {
    double coarser = 1.0;
    for (const double voxel_mm : {0.4, 0.2, 0.1}) {
        double error = 0.0;
        for (const study::StudiedMotion& motion : study::studied_motions(true)) {
            const auto series = study::run_motion(motion, {.voxel_mm = voxel_mm}, study::voxel_model());
            error += relative_error(study::mean_force_n(series), motion.reference_n);
        }
        EXPECT_LT(error, 0.6 * coarser) << voxel_mm << " mm";
        coarser = error;
    }
}

TEST(MeanForce, OfASlotIsSteadyFromStepToStep) {
    // Ripple: rms about the mean of steps of 10 ms.
    for (const ReferenceCase& c : testing::reference_cases()) {
        if (c.burr.diameter_mm != 5.0 || c.velocity_mm_per_s.z != 0.0 || c.previous_groove_mm_higher)
            continue;
        const auto series = study::run_steady(c, {}, study::voxel_model());
        EXPECT_LT(study::ripple(series), 0.02) << c.name;
    }
}

}  // namespace
}  // namespace osteomill::mean_force_test
