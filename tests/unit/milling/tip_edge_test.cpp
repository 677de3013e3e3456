#include "haptic_server/milling/tip_edge.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "haptic_server/milling/axis_means.h"
#include "haptic_server/milling/chip_force.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

constexpr double disc = tip_disc_voxels;
constexpr double flat = 1e6;  // radius of a burr that is flat as far as the disc reaches
constexpr glm::dvec3 down(0.0, 0.0, -0.5);

/// Sums over a chip of relative stiffness 2 that ends at y = `edge`, cut by a way of `way_voxels`.
TipSums half_plane(double edge, double way_voxels) {
    constexpr double cell = 0.01;
    TipSums sums;
    for (double y = -disc + 0.5 * cell; y < std::min(edge, disc); y += cell)
        for (double x = -disc + 0.5 * cell; x < disc; x += cell) {
            const double counted =
                std::max(0.0, 1.0 - (x * x + y * y) / (disc * disc)) * cell * cell * way_voxels;
            sums.area += counted;
            sums.stiffness += 2.0 * counted;
            sums.moment += counted * glm::dvec2(x, y);
        }
    return sums;
}

/// int_{y<edge} (1 - M) y / r^2 dA, in polar coordinates.
double missed_by_quadrature(double edge) {
    constexpr int radii = 1000;
    constexpr int angles = 2000;
    const double a = axis_disc_voxels;
    double sum = 0.0;
    for (int i = 0; i < radii; ++i) {
        const double r = a * (i + 0.5) / radii;
        const double within = r * r * axis_means(r * r, 1.0 / std::max(r, 0.1)).swirl;
        for (int j = 0; j < angles; ++j) {
            const double sine = std::sin(2.0 * std::numbers::pi * (j + 0.5) / angles);
            if (r * sine < edge) sum += (1.0 - within) * sine;
        }
    }
    return sum * a / radii * 2.0 * std::numbers::pi / angles;
}

TEST(TipEdge, FindsWhatTheMeansMissOfAHalfPlane) {
    for (const double edge : {-1.7, -1.0, -0.6, -0.2, 0.0, 0.1, 0.4, 0.8, 1.2, 1.8}) {
        TipEdge tip;
        tip.begin_step(glm::dmat3(1.0), flat, down);
        tip.add(half_plane(edge, 0.5));
        const double chip = 2.0 * 0.5;
        EXPECT_NEAR(tip.missing().y, chip * missed_by_quadrature(edge), 0.025) << "edge at " << edge;
        EXPECT_NEAR(tip.missing().x, 0.0, 1e-9);
    }
    EXPECT_NEAR(missed_by_quadrature(0.0), -0.823, 0.01) << "of 6.5, the force of a burr of ten voxels";
}

TEST(TipEdge, LeavesAChipAsItIsThatGoesOn) {
    for (const double edge : {-3.2, 2.95, 3.2, 4.0}) {
        TipEdge tip;
        tip.begin_step(glm::dmat3(1.0), flat, down);
        tip.add(half_plane(edge, 0.5));
        EXPECT_EQ(tip.missing(), glm::dvec2(0.0)) << "edge at " << edge;
        tip.begin_step(glm::dmat3(1.0), flat, down);
        EXPECT_EQ(tip.search().per_level, glm::vec2(0.0f)) << "edge at " << edge;
    }
}

TEST(TipEdge, MovesBoneTowardTheFaceByHowSteeplyItMeetsTheTip) {
    // The face keeps its distance: theta = 90 degrees straight ahead, 45 where the burr climbs as fast as it
    // advances.
    for (const double climb : {0.0, 1.0}) {
        TipEdge tip;
        const glm::dvec3 way(0.0, 0.5 * climb, -0.5);
        tip.begin_step(glm::dmat3(1.0), flat, way);
        tip.add(half_plane(0.3, glm::length(way)));
        tip.begin_step(glm::dmat3(1.0), flat, way);
        EXPECT_NEAR(tip.search().per_level.x, 0.0, 1e-6);
        EXPECT_NEAR(tip.search().per_level.y, climb == 0.0 ? 1.0 : std::tan(std::numbers::pi / 8.0), 1e-6);
    }
}

TEST(TipEdge, SaysNothingInAirNorWhereTheTipDoesNotAdvance) {
    TipEdge tip;
    tip.begin_step(glm::dmat3(1.0), flat, down);
    TipSums sums = half_plane(0.0, 0.5);
    sums.moved = {1.0, 2.0, 3.0};
    tip.add(sums);
    EXPECT_EQ(tip.moved(), sums.moved);
    EXPECT_LT(tip.missing().y, -0.5);

    tip.begin_step(glm::dmat3(1.0), flat, down);
    EXPECT_EQ(tip.moved(), glm::dvec3(0.0));
    EXPECT_EQ(tip.missing(), glm::dvec2(0.0));

    for (const glm::dvec3& way : {glm::dvec3(0.5, 0.0, 0.0), glm::dvec3(0.0, 0.0, 0.5), glm::dvec3(0.0)}) {
        tip.begin_step(glm::dmat3(1.0), flat, way);
        EXPECT_FALSE(tip.search().is_on);
    }
}

TEST(TipEdge, IsToldTheForceOfBoneWhereItLies) {
    // A voxel beside the tip that lost its last half: what lay a quarter of a voxel below its middle.
    Bone bone = testing::make_block(glm::dvec3(0.0), glm::dvec3(1.6), 0.1);
    const CuttingStep step(Burr{.diameter_mm = 1.0}, {0.0, 0.0, 1.0}, {8.0, 8.0, 8.0}, 0.1, 0.001);
    RemovedVoxels removed;
    removed.bone = &bone;
    removed.count = 1;
    removed.x[0] = 9.0f;
    removed.y[0] = 8.0f;
    removed.z[0] = 3.0f;
    removed.codes[0] = 127.5f;
    removed.slot[0] = 0;
    removed.offset[0] = 9 + 16 * (8 + 16 * 3);
    bone.fractions(0)[static_cast<std::size_t>(removed.offset[0])] = 0;
    removed.pad();
    std::array<float, RemovedVoxels::lanes> weights{0.5f};
    const TipSearch search{
        .is_on = true, .direction = {0.0f, 0.0f, -1.0f}, .least_share = 0.1f, .per_level = {0.0f, 0.8f}};
    const ChipSums sums = sum_of_chip_forces(step, removed, weights, InstructionSet::plain, search);
    EXPECT_EQ(sums.force, sum_of_chip_forces(step, removed, weights, InstructionSet::plain));
    EXPECT_NEAR(sums.tip.area, 0.5 * (1.0 - (25.0 / 26.0) / (disc * disc)), 1e-5) << "of a chip of 1";

    removed.y[0] -= 0.25f * 0.8f;
    const glm::dvec3 there = sum_of_chip_forces(step, removed, weights, InstructionSet::plain);
    EXPECT_LT(glm::length(sums.tip.moved - (there - sums.force)), 1e-4 * glm::length(there));
    EXPECT_GT(glm::length(sums.tip.moved), 0.05 * glm::length(there));
}

}  // namespace
}  // namespace osteomill
