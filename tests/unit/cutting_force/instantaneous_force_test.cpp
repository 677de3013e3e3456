#include "simulation/cutting_force/instantaneous_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "simulation/cutting_force/reference_force.h"
#include "tests/support/removed_voxel.h"
#include "tests/support/steady_motion.h"

namespace osteomill::instantaneous_force_test {
namespace {

using testing::ReferenceCase;
using testing::relative_error;

constexpr double two_pi = 2.0 * std::numbers::pi;
const glm::dvec3 up(0.0, 0.0, 1.0);

ReferenceCase slot_1_mm_deep() {
    for (const ReferenceCase& c : testing::reference_cases())
        if (c.name == "polish upright d=1.0") return c;
    throw std::runtime_error("no such case");
}

/// Steps of a tenth of a tooth period through a slot 1 mm deep; force and angle of the last `count` steps.
struct Instant {
    glm::dvec3 force_n;
    double turned_rad;  // by the edges, at the middle of the step
};

std::vector<Instant> last_instants(const ReferenceCase& c, int count) {
    const double step_s = 1e-4;
    const glm::dvec3 start(-1.0 + 0.031, 0.017, c.burr.radius_mm() - c.depth_mm);
    MillingModel model(testing::make_block({-5.0, -4.0, -2.0}, {4.0, 4.0, 0.0}, 0.1), {c.burr}, {},
                       {.summation = ForceSummation::instants, .instants_per_tooth = 20});
    ForgottenChanges changes;
    MillingResult result;
    std::vector<Instant> instants;
    const int steps = 1500;
    for (int i = 0; i <= steps; ++i) {
        model.step({.pose = {start + c.velocity_mm_per_s * (i * step_s), up},
                    .spindle_on = true,
                    .elapsed_s = step_s},
                   0.0, changes, result);
        const double turned = two_pi * c.burr.spindle_rev_per_s * (i + 0.5) * step_s;
        if (i > steps - count) instants.push_back({result.force_n, turned});
    }
    return instants;
}

TEST(InstantaneousForce, FollowsTheReferenceThroughTheToothPeriod) {
    // With six edges three always cut in a slot and the force hardly varies; with two it goes up and down.
    ReferenceCase c = slot_1_mm_deep();
    c.burr.edges = 2;
    const study::SteadyMotion motion{.burr = c.burr,
                                     .position_mm = {0.0, 0.0, c.burr.radius_mm() - c.depth_mm},
                                     .spindle_axis = up,
                                     .velocity_mm_per_s = c.velocity_mm_per_s};
    const double step_angle = two_pi * c.burr.spindle_rev_per_s * 1e-4;
    double rms = 0.0;
    double swing = 0.0;
    const auto instants = last_instants(c, 60);
    for (const Instant& instant : instants) {
        // Equation (1), averaged over the angle that the edges pass during the step.
        glm::dvec3 reference(0.0);
        for (int part = 0; part < 8; ++part)
            reference += study::instantaneous_reference_force_n(
                             motion, study::flat_bone(),
                             instant.turned_rad + step_angle * ((part + 0.5) / 8.0 - 0.5)) /
                         8.0;
        const glm::dvec3 error = instant.force_n - reference;
        rms += glm::dot(error, error) / static_cast<double>(instants.size());
        swing = std::max(swing, glm::length(reference - c.mean_force_n));
    }
    EXPECT_LT(std::sqrt(rms) / glm::length(c.mean_force_n), 0.05);
    EXPECT_GT(swing / glm::length(c.mean_force_n), 0.1) << "nothing to resolve";
}

TEST(InstantaneousForce, MeanOverItsInstantsIsTheMeanForce) {
    const ReferenceCase c = slot_1_mm_deep();
    glm::dvec3 mean(0.0);
    const auto instants = last_instants(c, 100);
    for (const Instant& instant : instants) mean += instant.force_n / static_cast<double>(instants.size());
    EXPECT_LT(relative_error(mean, c.mean_force_n), 0.01);
}

TEST(InstantaneousForce, OfALongStepIsItsMean) {
    const ReferenceCase c = slot_1_mm_deep();
    const auto mean = testing::run_steady(c, 0.1, 0.01, 1.0);
    const auto instants = testing::run_steady(c, 0.1, 0.01, 1.0, {.summation = ForceSummation::instants});
    EXPECT_LT(relative_error(instants.mean_force_n, mean.mean_force_n), 1e-9);
}

TEST(InstantaneousForce, PutsBoneWhereItsEdgeIs) {
    // One voxel at psi = 80.1 degrees, 2.5 degrees wide: with six edges that is 20.1 degrees into the pitch,
    // within bin 1 of 5.
    Burr burr;
    burr.sense = SpindleSense::counter_clockwise;
    InstantaneousForce force(5, InstructionSet::plain);
    force.turn(burr, 1e-4);
    force.begin_step(CuttingStep(burr, up, glm::dvec3(0.0), 0.1, 1e-4));
    testing::add_voxel(force, {4, 23, 0}, 1.0);
    for (int i = 0; i < force.instants(); ++i)
        EXPECT_EQ(glm::length(force.force_at_instant_n(i)) > 0.0, i == 1) << i;
}

TEST(InstantaneousForce, RefusesNoInstants) {
    EXPECT_THROW(InstantaneousForce(0, InstructionSet::plain), std::invalid_argument);
    EXPECT_THROW(InstantaneousForce(65, InstructionSet::plain), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::instantaneous_force_test
