// Heads that are no ball: the voxel model beside the analytical reference, and that beside closed forms.
#include "simulation/cutting_force/head_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "simulation/cutting_force/reference_force.h"
#include "simulation/force_models/milling_model.h"
#include "tests/support/block.h"

namespace osteomill::head_force_test {
namespace {

using study::BoneFunction;
using study::SteadyMotion;

Burr burr_of(HeadShape shape, double diameter_mm, double length_mm) {
    return {.name = "head",
            .diameter_mm = diameter_mm,
            .head = usual_head(shape, diameter_mm, length_mm),
            .sense = SpindleSense::counter_clockwise};
}

/// A plate between two heights, through which the sides of a head pass.
BoneFunction plate(double low_mm, double high_mm) {
    return [=](const glm::dvec3& p) { return p.z >= low_mm && p.z <= high_mm ? 1.0 : 0.0; };
}

TEST(HeadReference, MeetsTheClosedFormOfASlotByTheSideOfACylinder) {
    // A slot b deep by the side: F_x = -fr b K_r / 4, |F_y| = fr b K_t / 4, F_z = -fr b K_a / pi, and of
    // edges N b / pi (K_re, K_te) and N b / 2 K_ae.
    Burr burr = burr_of(HeadShape::cylinder, 2.0, 6.0);
    burr.edge_coefficients_n_per_mm = {0.5, 0.3, 0.1};
    const SteadyMotion motion{.burr = burr, .velocity_mm_per_s = {5.0, 0.0, 0.0}};
    const double b = 1.5;
    const glm::dvec3 force = mean_reference_force_n(motion, plate(1.0, 1.0 + b));
    const double fr = 5.0 / burr.spindle_rev_per_s;
    const double pi = std::numbers::pi;
    EXPECT_NEAR(force.x, -fr * b * 40.0 / 4.0 - burr.edges * b * 0.3 / pi, 1e-4);
    EXPECT_NEAR(std::abs(force.y), fr * b * 230.0 / 4.0 + burr.edges * b * 0.5 / pi, 1e-4);
    EXPECT_NEAR(force.z, -fr * b * 20.0 / pi - burr.edges * b * 0.1 / 2.0, 1e-4);
    EXPECT_NEAR(reference_removal_mm3_per_s(motion, plate(1.0, 1.0 + b)), 5.0 * 2.0 * b, 1e-3);
}

TEST(HeadReference, OfABallAsAHeadIsTheBalls) {
    // A pear's half ball alone is in bone: its chords are 0.2 % of the radius off the sphere.
    const Burr pear = burr_of(HeadShape::pear, 3.0, 6.0);
    Burr ball = pear;
    ball.head = {};
    SteadyMotion motion{.burr = ball, .position_mm = {0.0, 0.0, 0.7}, .velocity_mm_per_s = {4.0, 1.0, 0.0}};
    const glm::dvec3 of_ball = mean_reference_force_n(motion, study::flat_bone());
    motion.burr = pear;
    const glm::dvec3 of_pear = mean_reference_force_n(motion, study::flat_bone());
    EXPECT_LT(glm::length(of_pear - of_ball) / glm::length(of_ball), 5e-3);
}

class HeadInVoxels : public ::testing::TestWithParam<HeadShape> {};

TEST_P(HeadInVoxels, HasTheReferencesMeanForceAndRemoval) {
    Burr burr = burr_of(GetParam(), 2.4, 5.0);
    burr.edge_coefficients_n_per_mm = {0.4, 0.3, 0.05};
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));
    const glm::dvec3 velocity(7.0, 2.0, 0.0);
    const glm::dvec3 start(-1.503, -0.417, 0.331);
    Bone bone = testing::make_block({-4.0, -4.0, -4.0}, {5.0, 4.0, 0.0}, 0.1);
    MillingModel model(std::move(bone), {burr}, {});
    ForgottenChanges changes;
    auto result = std::make_unique<MillingResult>();
    glm::dvec3 sum(0.0);
    double removed_mm3 = 0.0;
    constexpr int steps = 300;
    for (int i = 0; i <= steps; ++i) {
        const BurrCommand command{.pose = {start + velocity * (0.001 * i), axis},
                                  .spindle_on = true,
                                  .elapsed_s = 0.001,
                                  .wants_engagement = false};
        model.step(command, 0.001 * i, changes, *result);
        if (i == 0) continue;
        sum += result->force_n;
        removed_mm3 += result->removed_mm3;
    }
    const SteadyMotion motion{
        .burr = burr, .position_mm = start, .spindle_axis = axis, .velocity_mm_per_s = velocity};
    const glm::dvec3 reference = mean_reference_force_n(motion, study::flat_bone());
    const glm::dvec3 mean = sum / static_cast<double>(steps);
    EXPECT_LT(glm::length(mean - reference) / glm::length(reference), 0.02)
        << mean.x << ' ' << mean.y << ' ' << mean.z << " for " << reference.x << ' ' << reference.y << ' '
        << reference.z;
    EXPECT_NEAR(removed_mm3 / (0.001 * steps) / reference_removal_mm3_per_s(motion, study::flat_bone()), 1.0,
                0.01);
}

INSTANTIATE_TEST_SUITE_P(All, HeadInVoxels,
                         ::testing::Values(HeadShape::cylinder, HeadShape::cone, HeadShape::barrel,
                                           HeadShape::pear),
                         [](const auto& test) {
                             return std::string(head_shape_names[static_cast<std::size_t>(test.param)]);
                         });

TEST(HeadInVoxels, CarvesAsTheSpindleTilts) {
    // A cylinder that swings about its origin by a right angle takes the sector that it sweeps.
    const Burr burr = burr_of(HeadShape::cylinder, 1.0, 4.0);
    MillingModel model(testing::make_block({-4.0, -1.0, -4.0}, {4.0, 1.0, 4.0}, 0.1), {burr}, {});
    ForgottenChanges changes;
    auto result = std::make_unique<MillingResult>();
    const auto step = [&](double angle) {
        const BurrCommand command{.pose = {{0.02, 0.01, -0.03}, {std::sin(angle), 0.0, std::cos(angle)}},
                                  .spindle_on = true,
                                  .elapsed_s = 0.05};
        model.step(command, 0.0, changes, *result);
        return result->removed_mm3;
    };
    step(0.0);
    const double in_one = step(0.5 * std::numbers::pi);
    // A quarter of the disc of radius 3.5 mm and of that of 0.5 mm, 1 mm thick but for the round sides of the
    // head, less what the head itself had taken.
    EXPECT_GT(in_one, 5.0);
    MillingModel fine(testing::make_block({-4.0, -1.0, -4.0}, {4.0, 1.0, 4.0}, 0.1), {burr}, {});
    double in_many = 0.0;
    for (int i = 0; i <= 90; ++i) {
        const double angle = 0.5 * std::numbers::pi * i / 90;
        const BurrCommand command{.pose = {{0.02, 0.01, -0.03}, {std::sin(angle), 0.0, std::cos(angle)}},
                                  .spindle_on = true,
                                  .elapsed_s = 0.001};
        fine.step(command, 0.0, changes, *result);
        if (i > 0) in_many += result->removed_mm3;
    }
    EXPECT_NEAR(in_one / in_many, 1.0, 0.01) << "however long the steps";
}

}  // namespace
}  // namespace osteomill::head_force_test
