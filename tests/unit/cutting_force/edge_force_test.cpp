// Edges that rub, in the voxel model: against the analytical reference, and consequences of the law.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "simulation/cutting_force/chip_force.h"
#include "simulation/cutting_force/edge_look.h"
#include "simulation/cutting_force/reference_force.h"
#include "studies/force/random_motions.h"
#include "studies/force/steady_case.h"
#include "tests/support/steady_motion.h"

namespace osteomill::edge_force_test {
namespace {

using testing::ReferenceCase;
using testing::relative_error;
using testing::run_steady;

ReferenceCase slot_1_mm_deep_with_edges() {
    for (ReferenceCase c : testing::reference_cases())
        if (c.name == "polish upright d=1.0") {
            c.burr.edge_coefficients_n_per_mm = {0.5, 0.4, 0.1};
            return c;
        }
    throw std::runtime_error("no such case");
}

glm::dvec3 reference_n(const ReferenceCase& c) {
    return study::mean_reference_force_n(study::motion_of(c), study::bone_of(c));
}

TEST(EdgeForce, IsTheReferencesInEverySteadyMotion) {
    for (ReferenceCase c : testing::reference_cases()) {
        c.burr.edge_coefficients_n_per_mm = {0.5, 0.4, 0.1};
        const glm::dvec3 found = run_steady(c, 0.1, 0.01, 2.0).mean_force_n;
        const glm::dvec3 expected = reference_n(c);
        EXPECT_LT(relative_error(found, expected), 0.055)
            << c.name << ": " << found.x << ' ' << found.y << ' ' << found.z << ", not " << expected.x << ' '
            << expected.y << ' ' << expected.z;
    }
}

TEST(EdgeForce, OfASlotIsThatOfTheFormula) {
    // Upright burr, slot of depth d, edges alone: F_y = sigma N_phi / 2 pi * K_te * 2 R k_d ... by
    // integrating K_te cos psi over the half that faces the feed, R dkappa up to cos k_d = 1 - d / R.
    ReferenceCase c = slot_1_mm_deep_with_edges();
    c.burr.edge_coefficients_n_per_mm = {0.5, 0.0, 0.0};
    ReferenceCase chips_alone = c;
    chips_alone.burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
    const glm::dvec3 edges =
        run_steady(c, 0.1, 0.01, 2.0).mean_force_n - run_steady(chips_alone, 0.1, 0.01, 2.0).mean_force_n;
    const double arc_mm = c.burr.radius_mm() * std::acos(1.0 - c.depth_mm / c.burr.radius_mm());
    const double expected = 0.5 * c.burr.edges / (2.0 * 3.14159265358979) * 2.0 * arc_mm;
    EXPECT_NEAR(std::abs(edges.y) / expected, 1.0, 0.03);
    EXPECT_LT(std::hypot(edges.x, edges.z), 0.03 * expected);
}

TEST(EdgeForce, DoesNotDependOnFeedSpindleSpeedOrTickRate) {
    const ReferenceCase c = slot_1_mm_deep_with_edges();
    const auto edges_alone = [](ReferenceCase with, double step_s) {
        const glm::dvec3 both = run_steady(with, 0.1, step_s, 2.0).mean_force_n;
        with.burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
        return both - run_steady(with, 0.1, step_s, 2.0).mean_force_n;
    };
    const glm::dvec3 edges = edges_alone(c, 0.01);
    ReferenceCase slower = c;
    slower.velocity_mm_per_s *= 0.25;
    EXPECT_LT(relative_error(edges_alone(slower, 0.01), edges), 0.02);
    ReferenceCase faster_spindle = c;
    faster_spindle.burr.spindle_rev_per_s *= 4.0;
    EXPECT_LT(relative_error(edges_alone(faster_spindle, 0.01), edges), 1e-6);
    EXPECT_LT(relative_error(edges_alone(c, 0.001), edges), 0.02);
    ReferenceCase more_edges = c;
    more_edges.burr.edges *= 2;
    EXPECT_LT(relative_error(edges_alone(more_edges, 0.01), 2.0 * edges), 1e-6) << "each edge rubs";
}

TEST(EdgeForce, IsSteadyAtASlowFeedAlongTheLattice) {
    ReferenceCase c = slot_1_mm_deep_with_edges();
    c.burr.diameter_mm = 1.5;
    c.velocity_mm_per_s = {1.0, 0.0, 0.0};
    c.burr.spindle_rev_per_s = 40'000.0 / 60.0;
    for (const double depth_mm : {0.1, 0.3}) {
        c.depth_mm = depth_mm;
        const study::ForceSeries series =
            study::run_steady(c, {.milling_rate_hz = 1000.0, .travel_mm = 0.5}, study::voxel_model());
        EXPECT_LT(relative_error(study::mean_force_n(series), reference_n(c)), 0.05) << depth_mm;
        EXPECT_LT(study::ripple(series), 0.05) << depth_mm;
        EXPECT_LT(study::largest_step(series), 1.5) << depth_mm;
    }
}

TEST(EdgeForce, RubsOnNothingInItsOwnGroove) {
    ReferenceCase c = slot_1_mm_deep_with_edges();
    MillingModel model(testing::make_block({-5.0, -4.0, -2.0}, {4.0, 4.0, 0.0}, 0.1), {c.burr}, {});
    ForgottenChanges changes;
    auto result = std::make_unique<MillingResult>();
    const auto go = [&](double x_mm) {
        model.step({.pose = {{x_mm, 0.017, c.burr.radius_mm() - 1.0}, {0.0, 0.0, 1.0}},
                    .spindle_on = true,
                    .elapsed_s = 0.001},
                   0.0, changes, *result);
        return glm::length(result->force_n);
    };
    for (int i = 0; i <= 100; ++i) go(0.005 * i);
    EXPECT_GT(go(0.505), 0.1);
    EXPECT_EQ(go(0.5), 0.0);
    EXPECT_EQ(go(0.2), 0.0);
}

/// Down into bone whose surface leans a little against the lattice, at 0.5 mm/s.
study::RandomMotion dive_of(double diameter_mm, double depth_mm, double dive_deg, double lean_deg,
                            double voxel_mm) {
    constexpr double degree = 3.14159265358979 / 180.0;
    study::RandomMotion drawn{.run = {.voxel_mm = voxel_mm, .milling_rate_hz = 1000.0}, .dives = true};
    ReferenceCase& c = drawn.motion;
    c.burr = {.diameter_mm = diameter_mm, .edges = 8, .spindle_rev_per_s = 500.0};
    c.burr.edge_coefficients_n_per_mm = {0.5, 0.4, 0.15};
    c.up = glm::normalize(glm::dvec3(0.15, -0.1, 1.0));
    c.depth_mm = depth_mm;
    const glm::dvec3 along = glm::normalize(glm::cross(c.up, glm::dvec3(0.2, 1.0, 0.0)));
    c.velocity_mm_per_s = 0.5 * (std::cos(dive_deg * degree) * along - std::sin(dive_deg * degree) * c.up);
    c.spindle_axis = std::cos(lean_deg * degree) * c.up + std::sin(lean_deg * degree) * along;
    return drawn;
}

// If edges used the face that the burr will have half a voxel on, each force would be off by a tenth or more.
TEST(EdgeForce, OfASteepShallowDiveIsThatOfTheFaceWhereTheBurrIs) {
    for (const double voxel_mm : {0.1, 0.15})
        for (const double dive_deg : {50.0, 70.0, 90.0})
            for (const double depth_voxels : {0.6, 1.2, 2.5})
                for (const double lean_deg : {-60.0, 45.0}) {
                    const study::RandomMotion drawn =
                        dive_of(2.6, depth_voxels * voxel_mm, dive_deg, lean_deg, voxel_mm);
                    const study::ForceSeries series =
                        study::run_steady(drawn.motion, drawn.run, study::voxel_model());
                    EXPECT_LT(
                        relative_error(study::mean_force_n(series), study::reference_over_path_n(drawn)),
                        0.08)
                        << voxel_mm << " mm, " << dive_deg << " deg, " << depth_voxels << " deep, "
                        << lean_deg;
                }
}

// The forces on both sides of the axis nearly cancel. The face grows by 2 % in the look, as much as rows of
// the lattice make it uneven: from the growth in one look alone the force was off by 10 %, wherever the
// surface lies in the lattice.
TEST(EdgeForce, OfADiveKnowsAFaceThatGrowsSlowlyFromTheLattice) {
    study::RandomMotion drawn = dive_of(1.3, 0.47, 65.0, -14.0, 0.1);
    drawn.motion.burr.edge_coefficients_n_per_mm = {0.9, 0.08, 0.07};
    const glm::dvec3 reference = study::reference_over_path_n(drawn);
    glm::dvec3 mean_n(0.0);
    for (const double surface_voxels : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
        drawn.run.surface_voxels = surface_voxels;
        mean_n += 0.2 * study::mean_force_n(study::run_steady(drawn.motion, drawn.run, study::voxel_model()));
    }
    EXPECT_LT(relative_error(mean_n, reference), 0.05);
}

TEST(EdgeForce, BeginsWhereTheBurrMeetsTheBoneWhereverThatLiesInItsVoxels) {
    glm::dvec3 mean_of_first_n(0.0);
    for (const double surface_mm : {0.0, -0.025, -0.01, 0.012, 0.025}) {
        ReferenceCase c = slot_1_mm_deep_with_edges();
        MillingModel model(testing::make_block({-3.0, -3.0, -2.0}, {3.0, 3.0, 1.0}, 0.1,
                                               [&](const glm::dvec3& p) { return surface_mm - p.z; }),
                           {c.burr}, {});
        ForgottenChanges changes;
        auto result = std::make_unique<MillingResult>();
        double before_n = 0.0;
        glm::dvec3 mean_n(0.0);
        for (double depth_mm = -0.3; depth_mm < 0.1; depth_mm += 0.0005) {
            const glm::dvec3 position_mm(0.031, 0.017, c.burr.radius_mm() - depth_mm + surface_mm);
            model.step({.pose = {position_mm, {0.6, 0.0, 0.8}}, .spindle_on = true, .elapsed_s = 0.001}, 0.0,
                       changes, *result);
            if (depth_mm < -0.025) before_n = std::max(before_n, glm::length(result->force_n));
            if (depth_mm > 0.0) mean_n += 0.0005 / 0.1 * result->force_n;
        }
        EXPECT_LT(before_n, 0.02 * glm::length(mean_n)) << surface_mm;
        if (mean_of_first_n == glm::dvec3(0.0)) mean_of_first_n = mean_n;
        EXPECT_LT(relative_error(mean_n, mean_of_first_n), 0.02) << surface_mm;
    }
}

TEST(EdgeForce, OfBinsAndOfInstantsAddsUpToTheSame) {
    const ReferenceCase c = slot_1_mm_deep_with_edges();
    const auto error_of = [&](double step_s, double travel_mm, ForceSummation summation) {
        return relative_error(run_steady(c, 0.1, step_s, travel_mm, {.summation = summation}).mean_force_n,
                              reference_n(c));
    };
    EXPECT_LT(error_of(0.01, 2.0, ForceSummation::bins), 0.08) << "coarse at the axis";
    EXPECT_LT(error_of(0.0001, 1.0, ForceSummation::instants), 0.03);
}

TEST(EdgeForce, CountsForNothingInThePublishedLaw) {
    const ReferenceCase c = slot_1_mm_deep_with_edges();
    ReferenceCase without = c;
    without.burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
    EXPECT_EQ(run_steady(c, 0.1, 0.01, 1.0, {.has_edge_forces = false}).mean_force_n,
              run_steady(without, 0.1, 0.01, 1.0).mean_force_n);
}

/// The look of a force in proportion to the face.
EdgeLook look_of(double voxels_per_look, double share) {
    return {glm::dvec3(0.0, 3.0, -1.0) * voxels_per_look, voxels_per_look * share};
}

TEST(EdgeLook, FollowsAFaceThatGrowsBackToTheMiddleOfTheStep) {
    // A face of 100 at the burr that grows by 80 over the path ahead: means of 140 over the path, 120 over
    // its half.
    const EdgeLook whole = look_of(140.0, 1.0);
    const EdgeLook half = look_of(120.0, 0.5);
    const auto face = [&](double step_share) {
        return (whole.force + EdgeGrowth().correction(whole, half, step_share, 1.0)).y / 3.0;
    };
    EXPECT_NEAR(face(1e-6), 100.0, 3.0);
    EXPECT_NEAR(face(0.5), 120.0, 2.0);
    EXPECT_EQ(face(1.0), 140.0);
    EXPECT_EQ(face(1.5), 140.0);
}

TEST(EdgeLook, LeavesTheLatticesOwnUnevennessAlone) {
    const EdgeLook whole = look_of(100.0, 1.0);
    EXPECT_LT(glm::length(EdgeGrowth().correction(whole, look_of(99.0, 0.5), 1e-6, 1.0)),
              0.005 * glm::length(whole.force));
    const EdgeLook thin = look_of(2.0, 1.0);
    EXPECT_LT(glm::length(EdgeGrowth().correction(thin, look_of(1.6, 0.5), 1e-6, 1.0)),
              0.06 * glm::length(thin.force));
}

TEST(EdgeLook, KnowsAGrowthOfTheLatticesSizeAfterHalfAVoxel) {
    const EdgeLook whole = look_of(104.0, 1.0);
    const EdgeLook half = look_of(102.0, 0.5);
    EdgeGrowth growth;
    const auto followed = [&] {
        return growth.correction(whole, half, 0.01, 1.0).y / (half.force.y - whole.force.y);
    };
    EXPECT_LT(followed(), 1.0);
    for (int i = 0; i < 60; ++i) followed();
    EXPECT_GT(followed(), 1.6);
    // Rows that come and go cancel out.
    growth.forget();
    for (int i = 0; i < 100; ++i)
        growth.correction(whole, look_of(i % 2 == 0 ? 101.0 : 107.0, 0.5), 0.02, 1.0);
    EXPECT_LT(glm::length(growth.correction(whole, look_of(101.0, 0.5), 0.02, 1.0)), 1.0);
}

TEST(EdgeLook, RubsOnNothingShortOfTheBone) {
    // Bone begins somewhere in the look's first or second half: the face is 0 until then.
    for (const double begins : {0.2, 0.6}) {
        const EdgeLook whole = look_of(400.0 * (1.0 - begins) * (1.0 - begins), 1.0);
        const double in_half = std::max(0.0, 0.5 - begins);
        const EdgeLook half = look_of(800.0 * in_half * in_half, 0.5);
        EXPECT_EQ(whole.force + EdgeGrowth().correction(whole, half, 1e-6, 1.0), glm::dvec3(0.0)) << begins;
    }
    EXPECT_EQ(EdgeGrowth().correction({}, {}, 0.1, 1.0), glm::dvec3(0.0));
}

TEST(EdgeAdvance, TimesTheAreaIsTheVolumeThatAPartlyPassedFaceLoses) {
    // Area 1, path 1, the cosine running evenly from x - w to x + w: the volume is the mean of its positive
    // part, the area that rubs its mean duration.
    for (const double w : {0.05, 0.2})
        for (const double x : {-0.5 * w, 0.0, 0.7 * w, w, 3.0 * w}) {
            double volume = 0.0;
            double area = 0.0;
            constexpr int parts = 20'000;
            for (int i = 0; i < parts; ++i) {
                const double cosine = x + w * ((2.0 * i + 1.0) / parts - 1.0);
                volume += std::max(0.0, cosine) / parts;
                area += (cosine > 0.0) / static_cast<double>(parts);
            }
            EXPECT_NEAR(volume / edge_advance(x, w), area, 1e-3) << x << ' ' << w;
        }
}

}  // namespace
}  // namespace osteomill::edge_force_test
