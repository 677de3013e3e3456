#include "studies/force/studied_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "simulation/cutting_force/reference_force.h"

namespace osteomill::study {
namespace {

const StudiedMotion& named(const std::vector<StudiedMotion>& motions, const std::string& name) {
    for (const StudiedMotion& motion : motions)
        if (motion.name == name) return motion;
    throw std::runtime_error("no motion " + name);
}

TEST(StudiedMotions, HaveReferencesThatAgreeWithTheTable) {
    // The same motions stand in tests/data/milling_forces.json.
    const auto motions = studied_motions(true);
    EXPECT_LT(relative_error(named(motions, "polishing").reference_n, {-0.345212, -2.069631, 0.238536}),
              1e-3);
    EXPECT_LT(relative_error(named(motions, "tilted").reference_n, {1.085054, -2.052566, 2.238167}), 1e-3);
    EXPECT_LT(relative_error(named(motions, "plunging").reference_n, {0.0, 0.0, 0.642478}), 1e-3);
}

TEST(StudiedMotions, TurnTheForceWithACurvedPath) {
    // A burr upright on a flat surface: the force turns with the heading, so its mean over an angle a is that
    // of the straight motion, turned by a/2 and shorter by sin(a/2) / (a/2) in the plane.
    const auto motions = studied_motions(true);
    const StudiedMotion& curved = named(motions, "curved");
    const glm::dvec3 straight_n = named(motions, "polishing").reference_n;
    const double half_angle = 0.5 * curved.duration_s * 6.0 / 3.0;
    const double shorter = std::sin(half_angle) / half_angle;
    const glm::dvec3 expected(
        shorter * (std::cos(half_angle) * straight_n.x - std::sin(half_angle) * straight_n.y),
        shorter * (std::sin(half_angle) * straight_n.x + std::cos(half_angle) * straight_n.y), straight_n.z);
    EXPECT_LT(relative_error(curved.reference_n, expected), 1e-3);
}

TEST(StudiedMotions, GiveEachLayerItsShare) {
    // Force is linear in stiffness: 0.4 everywhere, and 0.6 more in what is deeper than the layer's 0.8 mm.
    const auto motions = studied_motions(true);
    const StudiedMotion& layered = named(motions, "two layers");
    const auto slot = [&](double depth_mm) {
        return mean_reference_force_n({.burr = layered.burr,
                                       .position_mm = {0.0, 0.0, 2.5 - depth_mm},
                                       .spindle_axis = layered.spindle_axis,
                                       .velocity_mm_per_s = {6.0, 0.0, 0.0}},
                                      flat_bone());
    };
    EXPECT_LT(relative_error(layered.reference_n, 0.4 * slot(1.5) + 0.6 * slot(0.7)), 1e-3);
}

TEST(StudiedMotions, AreFeltByTheVoxelModel) {
    for (const StudiedMotion& motion : studied_motions(true)) {
        const ForceSeries series = run_motion(motion, {}, voxel_model());
        EXPECT_LT(relative_error(mean_force_n(series), motion.reference_n), 0.02) << motion.name;
    }
}

}  // namespace
}  // namespace osteomill::study
