#include "studies/force/steady_run.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace osteomill::study {
namespace {

SteadyCase slot() {
    return {.name = "slot",
            .burr = {.diameter_mm = 2.0, .sense = SpindleSense::counter_clockwise},
            .velocity_mm_per_s = {6.0, 0.0, 0.0},
            .depth_mm = 0.6};
}

TEST(SteadyPath, GoesOnAlongTheSurfaceInWholeSteps) {
    const SteadyPath path = path_of(slot(), {.travel_mm = 3.0});
    EXPECT_EQ(path.steps, 50);
    EXPECT_NEAR(glm::length(path.end_mm - path.start_mm), 3.0, 1e-12);
    EXPECT_EQ(path.start_mm.z, 0.4);
    EXPECT_EQ(path.end_mm.z, 0.4);
}

TEST(SteadyPath, IsLongEnoughForAMeanWhereTheFeedIsFast) {
    SteadyCase fast = slot();
    fast.velocity_mm_per_s = {50.0, 0.0, 0.0};
    EXPECT_EQ(path_of(fast, {.travel_mm = 1.0, .min_steps = 20}).steps, 20);
}

TEST(SteadyPath, PassesTheDepthHalfWayWhereItDives) {
    SteadyCase dive = slot();
    dive.velocity_mm_per_s = {3.0, 0.0, -3.0};
    const SteadyPath path = path_of(dive, {.travel_mm = 5.0});
    EXPECT_NEAR(0.5 * (path.start_mm.z + path.end_mm.z), 0.4, 1e-12);
    EXPECT_LE(path.start_mm.z - path.end_mm.z, 0.2) << "a third of the depth";
    EXPECT_GE(path.start_mm.z - path.end_mm.z, 0.1);
}

TEST(SteadyPath, PlungesOnFromHalfImmersion) {
    SteadyCase plunge = slot();
    plunge.velocity_mm_per_s = {0.0, 0.0, -2.0};
    plunge.depth_mm = 1.0;
    const SteadyPath path = path_of(plunge, {.travel_mm = 2.0});
    EXPECT_EQ(path.start_mm.z, 0.0);
    EXPECT_NEAR(path.end_mm.z, -2.0, 1e-12);
}

TEST(SteadyRun, MovesForceAndRemovalWithTheSurface) {
    // The whole scene turned by 90 degrees, block and lattice alike: the same force, turned.
    const auto turned = [](const glm::dvec3& v) { return glm::dvec3(v.z, v.x, v.y); };
    const SteadyCase flat = slot();
    SteadyCase wall = flat;
    wall.velocity_mm_per_s = turned(flat.velocity_mm_per_s);
    wall.spindle_axis = turned(flat.spindle_axis);
    wall.up = turned(flat.up);
    const ForceSeries a = run_steady(flat, {}, voxel_model());
    const ForceSeries b = run_steady(wall, {}, voxel_model());
    EXPECT_LT(relative_error(mean_force_n(b), turned(mean_force_n(a))), 0.01);
    EXPECT_NEAR(removal_mm3_per_s(b) / removal_mm3_per_s(a), 1.0, 0.01);
    EXPECT_LT(relative_error(mean_force_n(b), mean_reference_force_n(motion_of(wall), bone_of(wall))), 0.02);
}

TEST(SteadyRun, FeelsTheSameWhereverTheSurfaceLiesInTheLattice) {
    const glm::dvec3 in_place_n = mean_force_n(run_steady(slot(), {}, voxel_model()));
    for (const double by : {-0.25, 0.25}) {
        const glm::dvec3 moved_n = mean_force_n(run_steady(slot(), {.surface_voxels = by}, voxel_model()));
        EXPECT_LT(relative_error(moved_n, in_place_n), 0.02) << by;
        EXPECT_NE(moved_n, in_place_n);
    }
    const SteadyPath path = path_of(slot(), {.surface_voxels = 0.25});
    EXPECT_NEAR(path.start_mm.z, 0.4 + 0.025, 1e-12);
}

TEST(SteadyRun, CutsLessWhereAGrooveWentBefore) {
    SteadyCase second = slot();
    second.previous_groove_mm_higher = 0.1;
    const ForceSeries series = run_steady(second, {}, voxel_model());
    const SteadyMotion motion = motion_of(second);
    EXPECT_NEAR(removal_mm3_per_s(series) / reference_removal_mm3_per_s(motion, bone_of(second)), 1.0, 0.02);
    EXPECT_EQ(series.step_us.size(), series.force_n.size());
}

}  // namespace
}  // namespace osteomill::study
