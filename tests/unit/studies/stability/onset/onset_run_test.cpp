#include "studies/stability/onset/onset_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "simulation/cutting_force/reference_force.h"

namespace osteomill::study::onset_run_test {
namespace {

const glm::dvec3 aslant(0.36, 0.48, 0.8);

Onset plunge(const glm::dvec3& up, double speed_mm_per_s = 20.0) {
    return {.burr = {.diameter_mm = 3.0}, .up = up, .speed_mm_per_s = speed_mm_per_s};
}

TEST(ImpulseByWay, RisesAsTheReferenceForceSays) {
    for (const glm::dvec3& up : {glm::dvec3(0.0, 0.0, 1.0), aslant}) {
        const Onset onset = plunge(up);
        const ImpulseByWay impulse(onset);
        const OnsetLine line = line_of(onset);
        // Over a voxel's layer, along which the lattice's ripple cancels.
        const double from_mm = onset.before_touch_mm + 0.3;
        glm::dvec3 expected_n_s(0.0);
        constexpr int parts = 10;
        for (int i = 0; i < parts; ++i)
            expected_n_s += 0.1 / parts *
                            mean_reference_force_n(
                                {onset.burr, line.at(from_mm + 0.1 * (i + 0.5) / parts), up, line.direction},
                                [&](const glm::dvec3& p) { return glm::dot(p, up) <= 0.0 ? 1.0 : 0.0; });
        const glm::dvec3 found_n_s = impulse.at(from_mm + 0.1) - impulse.at(from_mm);
        EXPECT_LT(glm::distance(found_n_s, expected_n_s), 0.02 * glm::length(expected_n_s)) << up.z;
        EXPECT_LT(impulse.along(from_mm + 0.1), impulse.along(from_mm)) << "it resists";
        EXPECT_EQ(impulse.at(0.1), glm::dvec3(0.0)) << "in air";
    }
}

TEST(ImpulseByWay, RefusesForcesThatAreNoChips) {
    Onset rubbing = plunge(aslant);
    rubbing.burr.edge_coefficients_n_per_mm = {0.3, 0.3, 0.0};
    EXPECT_THROW(ImpulseByWay{rubbing}, std::invalid_argument);
    Onset cylinder = plunge(aslant);
    cylinder.burr.head = usual_head(HeadShape::cylinder, 3.0, 4.0);
    EXPECT_THROW(ImpulseByWay{cylinder}, std::invalid_argument);
}

TEST(OnsetRun, OfARigidBurrOnRailsIsTheMillingModels) {
    for (const glm::dvec3& up : {glm::dvec3(0.0, 0.0, 1.0), aslant}) {
        const OnsetRun run = run_onset(plunge(up), {.coupling = "hold"});
        const double exact_n = peak_of(run.exact_n, 0.0).peak_n;
        EXPECT_GT(exact_n, 1.0);
        EXPECT_NEAR(peak_of(run.felt_n, 0.0).peak_n, exact_n, 0.001 * exact_n);
    }
}

TEST(OnsetRun, OfAnIdealSpringTendsToTheExactAnswerAsItStiffens) {
    double last = 0.0;
    for (const double stiffness : {1.5, 15.0, 150.0}) {
        const OnsetRun run = run_onset(
            plunge(aslant), {.stiffness_n_per_mm = stiffness, .damping_n_s_per_mm = 0.0025 * stiffness});
        const double share = peak_of(run.ideal_n, 0.0).peak_n / peak_of(run.exact_n, 0.0).peak_n;
        EXPECT_GT(share, last);
        EXPECT_LT(share, 1.0);
        last = share;
    }
    EXPECT_GT(last, 0.95);
}

/// Where bone is all that resists, a firm hand of 0.545 kg loses its momentum to it: the impulse by depth is
/// that momentum, but for what hand and arm add within these few milliseconds.
TEST(OnsetRun, TakesTheHandsMomentum) {
    const Onset onset = plunge({0.0, 0.0, 1.0}, 60.0);
    const OnsetRun run = run_onset(onset, {.is_guided = true});
    double taken_n_s = 0.0;
    double peak_n = 0.0;
    for (const glm::dvec3& force_n : run.exact_n) {
        if (force_n.z < 0.5 * peak_n) break;
        peak_n = std::max(peak_n, force_n.z);
        taken_n_s += 0.001 * force_n.z;
    }
    EXPECT_GT(taken_n_s, 0.4 * 0.545 * 0.06);
    EXPECT_LT(taken_n_s, 1.0 * 0.545 * 0.06);
}

/// Slow hands meet the map's first touch, stiff springs show it most.
TEST(OnsetRun, OfImplicitIsThatOfAnIdealSpring) {
    for (const glm::dvec3& up : {glm::dvec3(0.0, 0.0, 1.0), aslant})
        for (const double stiffness : {1.5, 3.0, 30.0})
            for (const bool is_guided : {false, true})
                for (const double speed_mm_per_s : {5.0, 20.0}) {
                    const OnsetRun run =
                        run_onset(plunge(up, speed_mm_per_s),
                                  {.stiffness_n_per_mm = stiffness,
                                   .damping_n_s_per_mm = stiffness < 30.0 ? 0.004 / 1.5 * stiffness : 0.08,
                                   .is_guided = is_guided});
                    const double exact_n = peak_of(run.exact_n, 0.0).peak_n;
                    const OnsetPeak ideal = peak_of(run.ideal_n, exact_n);
                    const OnsetPeak felt = peak_of(run.felt_n, exact_n);
                    EXPECT_NEAR(felt.peak_n / exact_n, ideal.peak_n / exact_n, 0.0325)
                        << up.z << ", " << stiffness << " N/mm, " << speed_mm_per_s << " mm/s, guided "
                        << is_guided;
                }
}

TEST(OnsetRun, RefusesWhatIsNoOnset) {
    EXPECT_THROW(run_onset(plunge(aslant, 0.0), {}), std::invalid_argument);
    EXPECT_THROW(run_onset(plunge(aslant), {.stiffness_n_per_mm = 0.0}), std::invalid_argument);
    EXPECT_THROW(run_onset(plunge(aslant), {.coupling = "glue"}), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study::onset_run_test
