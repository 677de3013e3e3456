#include "studies/stability/map/swept_bone.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "simulation/cutting_force/reference_force.h"

namespace osteomill::study::swept_bone_test {
namespace {

constexpr double substep_s = 1e-5;

/// Moves the burr at a constant velocity, for so many ticks; returns the force at the end.
glm::dvec3 force_when_moved(SweptBone& bone, const glm::dvec3& velocity_mm_per_s, int ticks) {
    constexpr double unyielding_n_s_per_mm = 1e4;
    glm::dvec3 force_n(0.0);
    for (int tick = 0; tick < ticks; ++tick) {
        bone.refresh();
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 w = bone.solve(glm::dvec3(unyielding_n_s_per_mm),
                                            unyielding_n_s_per_mm * velocity_mm_per_s, substep_s);
            force_n = unyielding_n_s_per_mm * (w - velocity_mm_per_s);
            bone.advance(substep_s * velocity_mm_per_s);
        }
    }
    return force_n;
}

TEST(SweptBone, ResistsAFreshSlotAsTheReferenceSays) {
    for (const double depth_mm : {0.25, 1.0, 2.5, 4.0, 5.0}) {
        SteadyMotion motion;
        motion.velocity_mm_per_s = {6.0, 0.0, 0.0};
        motion.position_mm = {0.0, 0.0, motion.burr.radius_mm() - depth_mm};
        const glm::dvec3 expected_n = 0.5 * mean_reference_force_n(motion, flat_bone());
        SweptBone bone(motion.burr, 0.5, motion.position_mm);
        const glm::dvec3 force_n = force_when_moved(bone, motion.velocity_mm_per_s, 20);
        EXPECT_LT(glm::distance(force_n, expected_n), 0.005 * glm::length(expected_n)) << depth_mm;
    }
}

TEST(SweptBone, RubsAsTheReferenceSays) {
    for (const double speed_mm_per_s : {0.5, 6.0}) {
        SteadyMotion motion;
        motion.burr.edge_coefficients_n_per_mm = {0.3, 0.2, 0.1};
        motion.velocity_mm_per_s = {speed_mm_per_s, 0.0, 0.0};
        motion.position_mm = {0.0, 0.0, motion.burr.radius_mm() - 1.0};
        const glm::dvec3 expected_n = mean_reference_force_n(motion, flat_bone());
        SweptBone bone(motion.burr, 1.0, motion.position_mm);
        const glm::dvec3 force_n = force_when_moved(bone, motion.velocity_mm_per_s, 20);
        EXPECT_LT(glm::distance(force_n, expected_n), 0.02 * glm::length(expected_n)) << speed_mm_per_s;
    }
}

TEST(SweptBone, HoldsABurrThatIsPushedByLessThanItsEdgesTake) {
    Burr burr;
    // A tangential part would pull it along; on a plane, or it would climb out.
    burr.edge_coefficients_n_per_mm = {0.0, 0.3, 0.0};
    SweptBone bone(burr, 1.0, {0.0, 0.0, 1.5});
    glm::dvec3 w(0.0);
    for (int i = 0; i < 200; ++i) {
        w = bone.solve({0.002, 0.002, 1e4}, {0.2, 0.0, 0.0}, substep_s);
        bone.advance(substep_s * w);
    }
    EXPECT_LT(glm::length(w), 1.0) << "100 mm/s without bone";
}

TEST(SweptBone, ResistsASlotDeepenedByASecondPassAsTheReferenceSays) {
    // From the end of the first slot it goes down and back under it, 1 mm deeper.
    SteadyMotion motion;
    motion.velocity_mm_per_s = {-6.0, 0.0, 0.0};
    SweptBone bone(motion.burr, 1.0, {0.0, 0.0, 1.5});
    force_when_moved(bone, {0.0, 0.0, -20.0}, 50);
    motion.position_mm = bone.burr_mm();
    const glm::dvec3 force_n = force_when_moved(bone, motion.velocity_mm_per_s, 60);
    const glm::dvec3 expected_n =
        mean_reference_force_n(motion, flat_bone_with_groove(motion.position_mm + glm::dvec3(0.0, 0.0, 1.0),
                                                             {1.0, 0.0, 0.0}, motion.burr.radius_mm()));
    EXPECT_LT(glm::distance(force_n, expected_n), 0.02 * glm::length(expected_n));
}

TEST(SweptBone, GivesNothingToABurrThatDrawsBackAndReturnsUntilItMeetsItsFront) {
    SweptBone bone(Burr{}, 1.0, {0.0, 0.0, 1.5});
    EXPECT_GT(glm::length(force_when_moved(bone, {6.0, 0.0, 0.0}, 50)), 1.0);
    EXPECT_LT(glm::length(force_when_moved(bone, {-6.0, 0.0, 0.0}, 40)), 1e-6);
    EXPECT_LT(glm::length(force_when_moved(bone, {6.0, 0.0, 0.0}, 35)), 1e-6);
    EXPECT_GT(glm::length(force_when_moved(bone, {6.0, 0.0, 0.0}, 10)), 1.0);
}

}  // namespace
}  // namespace osteomill::study::swept_bone_test
