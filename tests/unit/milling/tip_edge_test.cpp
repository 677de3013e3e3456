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
constexpr glm::dvec3 ahead(0.0, 1.0, 0.0);  // out of bone that ends straight ahead

/// Sums over a chip of relative stiffness 2 that ends at y = `edge`, cut by `way` of bone that ends in a face
/// of outward normal `normal`.
TipSums half_plane(double edge, const glm::dvec3& way = down, const glm::dvec3& normal = ahead) {
    constexpr double cell = 0.01;
    TipSums sums;
    for (double y = -disc + 0.5 * cell; y < std::min(edge, disc); y += cell)
        for (double x = -disc + 0.5 * cell; x < disc; x += cell) {
            const double counted =
                std::max(0.0, 1.0 - (x * x + y * y) / (disc * disc)) * cell * cell * -way.z;
            sums.volume += counted;
            sums.stiffness += 2.0 * counted;
            sums.moment += counted * glm::dvec2(x, y);
        }
    sums.places = 3.0 * way - 5.0 * normal;
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

TipEdge begun(const glm::dvec3& way = down) {
    TipEdge tip(best_instruction_set());
    tip.begin_step(glm::dmat3(1.0), flat, way);
    return tip;
}

TEST(TipEdge, FindsWhatTheMeansMissOfAHalfPlane) {
    for (const double edge : {-1.7, -1.0, -0.6, -0.2, 0.0, 0.1, 0.4, 0.8, 1.2, 1.8}) {
        TipEdge tip = begun();
        tip.add(half_plane(edge));
        const glm::dvec3 missing = tip.end_step();
        const double chip = 2.0 * 0.5;
        // As much as comes of a hundredth of the disc's radius.
        EXPECT_NEAR(missing.y, chip * missed_by_quadrature(edge), 0.1) << "edge at " << edge;
        EXPECT_NEAR(missing.x, 0.0, 0.01);
    }
    EXPECT_NEAR(missed_by_quadrature(0.0), -0.823, 0.01) << "of 6.5, the force of a burr of ten voxels";
}

TEST(TipEdge, LeavesAChipAsItIsThatGoesOn) {
    for (const double edge : {-3.2, 2.95, 3.2, 4.0}) {
        TipEdge tip = begun();
        tip.add(half_plane(edge));
        EXPECT_EQ(tip.end_step(), glm::dvec3(0.0)) << "edge at " << edge;
        tip.begin_step(glm::dmat3(1.0), flat, down);
        EXPECT_EQ(tip.search().per_level, glm::vec2(0.0f)) << "edge at " << edge;
        EXPECT_EQ(tip.search().per_depth, glm::vec2(0.0f)) << "edge at " << edge;
    }
}

TEST(TipEdge, LeavesAChipAsItIsThatEndsInNoFace) {
    // A hole where the axis is, all round.
    TipSums ring = half_plane(4.0);
    const TipSums hole = half_plane(0.0);
    ring.volume -= hole.volume;
    ring.stiffness -= hole.stiffness;
    ring.moment = glm::dvec2(0.0);
    TipEdge tip = begun();
    tip.add(ring);
    EXPECT_EQ(tip.end_step(), glm::dvec3(0.0));
}

TEST(TipEdge, MovesBoneByHowSteeplyTheFaceMeetsTheTip) {
    // The face keeps its distance: theta = 90 degrees straight ahead, 45 where the burr climbs as fast as it
    // advances.
    for (const double climb : {0.0, 1.0}) {
        const glm::dvec3 way(0.0, 0.5 * climb, -0.5);
        TipEdge tip = begun(way);
        tip.add(half_plane(0.3, way, glm::normalize(glm::dvec3(0.0, 1.0, climb))));
        tip.end_step();
        tip.begin_step(glm::dmat3(1.0), flat, way);
        EXPECT_NEAR(tip.search().per_level.x, 0.0, 0.02);
        EXPECT_NEAR(tip.search().per_level.y, std::sqrt(1.0 + climb * climb), 0.01);
        EXPECT_NEAR(tip.search().per_depth.y, climb, 0.01);

        // In the patient's axes the face stays where it is while the burr turns about its own.
        const glm::dmat3 turned(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
        tip.begin_step(turned, flat, way);
        EXPECT_NEAR(tip.search().per_level.x, std::sqrt(1.0 + climb * climb), 0.01);
    }
}

TEST(TipEdge, SaysNothingInAirNorWhereTheTipDoesNotAdvance) {
    TipEdge tip = begun();
    TipSums sums = half_plane(0.0);
    sums.moved = {1.0, 2.0, 3.0};
    sums.all = sums.stiffness;
    tip.add(sums);
    EXPECT_EQ(tip.evened(), sums.moved);
    EXPECT_LT(tip.end_step().y, -0.5);

    tip.begin_step(glm::dmat3(1.0), flat, down);
    EXPECT_EQ(tip.evened(), glm::dvec3(0.0));
    EXPECT_EQ(tip.end_step(), glm::dvec3(0.0));

    for (const glm::dvec3& way : {glm::dvec3(0.5, 0.0, 0.0), glm::dvec3(0.0, 0.0, 0.5), glm::dvec3(0.0)}) {
        tip.begin_step(glm::dmat3(1.0), flat, way);
        EXPECT_FALSE(tip.search().is_on);
    }
    tip.begin_step(glm::dmat3(1.0), 3.5, down);
    EXPECT_FALSE(tip.search().is_on) << "a burr hardly thicker than the disc";
}

/// What is felt beside the step's own force in the second of two steps of half a voxel: the first has a force
/// of 6 and cuts ten times the whole disc, the second has none and cuts of tip and of all so many times that.
double evened_after(double tip_share, double all_share) {
    TipEdge tip = begun();
    TipSums sums = half_plane(4.0);
    sums.force = {6.0, 0.0, 0.0};
    sums.all = 10.0 * sums.stiffness;
    tip.add(sums);
    EXPECT_EQ(tip.evened(), glm::dvec3(0.0));
    tip.end_step();

    sums.volume *= tip_share;
    sums.stiffness *= tip_share;
    sums.all *= all_share;
    sums.force = glm::dvec3(0.0);
    tip.begin_step(glm::dmat3(1.0), flat, down);
    tip.add(sums);
    return tip.evened().x;
}

TEST(TipEdge, EvensTheTipsForceOverThreeVoxelsOfTheWay) {
    const double kept = std::exp(-0.5 / 3.0);
    const auto share_of = [&](double share) { return share / (kept + share); };
    EXPECT_NEAR(evened_after(1.0, 1.0), 6.0 * kept * share_of(1.0), 1e-9);
    // Half of all is half of what is remembered.
    EXPECT_NEAR(evened_after(0.5, 0.5), 6.0 * kept * share_of(0.5), 1e-9);
    // So little does the lattice, and all counts; a tip that cuts less counts at once.
    EXPECT_NEAR(evened_after(0.9, 1.0), 6.0 * kept * share_of(1.0), 1e-9);
    EXPECT_NEAR(evened_after(0.2, 1.0), 6.0 * kept * 1.2 * share_of(0.2), 1e-9);
    EXPECT_EQ(evened_after(0.0, 1.0), 0.0);
}

TEST(TipEdge, IsToldTheForceOfBoneWhereItLies) {
    // A voxel beside the tip that lost its last half, a little outside the burr.
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
    const TipSearch search{.is_on = true, .per_level = {0.0f, 0.8f}, .per_depth = {0.0f, 0.6f}};
    const ChipSums sums = sum_of_chip_forces(step, removed, weights, InstructionSet::plain, search);
    const glm::dvec3 force = sum_of_chip_forces(step, removed, weights, InstructionSet::plain);
    EXPECT_EQ(sums.force, force);
    const double counted = 1.0 - (25.0 / 26.0) / (disc * disc);
    EXPECT_NEAR(sums.tip.volume, 0.5 * counted, 1e-5);
    EXPECT_NEAR(sums.tip.stiffness, 0.5 * counted, 1e-5);
    EXPECT_EQ(sums.tip.all, 0.5);
    EXPECT_LT(glm::length(sums.tip.force - counted * force), 1e-5 * glm::length(force));
    EXPECT_LT(glm::length(sums.tip.places - 0.5 * glm::dvec3(1.0, 0.0, -5.0)), 1e-5);

    const double depth = 5.0 - std::sqrt(26.0);
    removed.y[0] += static_cast<float>(-0.25 * 0.8 + depth * 0.6);
    const glm::dvec3 there = sum_of_chip_forces(step, removed, weights, InstructionSet::plain);
    EXPECT_LT(glm::length(sums.tip.moved - (there - force)), 1e-4 * glm::length(there));
    EXPECT_GT(glm::length(sums.tip.moved), 0.05 * glm::length(there));
}

}  // namespace
}  // namespace osteomill
