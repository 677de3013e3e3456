#include "simulation/engagement/engagement_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <numbers>

#include "simulation/cutting_force/reference_force.h"
#include "simulation/force_models/milling_model.h"
#include "tests/support/block.h"

namespace osteomill::engagement_probe_test {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

/// Flat bone below z = 0.
Bone flat_block() {
    return testing::make_block({-4.0, -4.0, -3.0}, {4.0, 4.0, 0.0}, 0.1);
}

TEST(Engagement, IsEmptyInFreeAir) {
    const Bone bone = flat_block();
    EngagementProbe probe(Burr{.diameter_mm = 2.0}, 0.1);
    auto engagement = std::make_unique<Engagement>();
    for (const glm::dvec3 position : {glm::dvec3(0, 0, 1.5), glm::dvec3(0, 0, 100), glm::dvec3(-1e9, 0, 0)}) {
        probe.sample(bone, position, up, *engagement);
        EXPECT_EQ(engagement->count, 0U);
    }
}

TEST(Engagement, GapIsTheDistanceToAFlatSurface) {
    const Bone bone = flat_block();
    const Burr burr{.diameter_mm = 5.0};
    EngagementProbe probe(burr, 0.1);
    auto engagement = std::make_unique<Engagement>();
    for (const double height : {0.08, 0.02, -0.06}) {
        probe.sample(bone, {0.0, 0.0, 2.5 + height}, up, *engagement);
        ASSERT_GT(engagement->count, 0U) << height;
        double smallest = 1.0;
        for (std::size_t i = 0; i < engagement->count; ++i) {
            const EngagedPatch& patch = engagement->patches[i];
            smallest = std::min(smallest, patch.gap_mm);
            // Along its normal a patch meets the plane z = 0 at (2.5 + height) / -n.z from the centre.
            const double expected = (2.5 + height) / -patch.normal.z - 2.5;
            if (expected > -0.1) {
                EXPECT_NEAR(patch.gap_mm, expected, 0.02);
            }
        }
        EXPECT_NEAR(smallest, height, 0.02);
    }
}

TEST(Engagement, PatchesCoverTheSphereTheyTouch) {
    const Bone bone = testing::make_block({-3.0, -3.0, -3.0}, {3.0, 3.0, 3.0}, 0.1);
    const Burr burr{.diameter_mm = 2.0};
    auto engagement = std::make_unique<Engagement>();
    EngagementProbe(burr, 0.1).sample(bone, glm::dvec3(0.0), up, *engagement);
    double area = 0.0;
    for (std::size_t i = 0; i < engagement->count; ++i) area += engagement->patches[i].area_mm2;
    EXPECT_NEAR(area, 4.0 * 3.14159265 * 1.0, 0.01);
}

TEST(Engagement, AdvancingIntoAFreshSlotPredictsTheReferenceForce) {
    // Fully immersed and moving along x, patches with n . v > 0 cut: reference case "polish upright d=5.0".
    const Bone bone = testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 4.0}, 0.1);
    Burr burr;
    burr.sense = SpindleSense::counter_clockwise;
    auto engagement = std::make_unique<Engagement>();
    EngagementProbe(burr, 0.1).sample(bone, glm::dvec3(0.0), up, *engagement);
    glm::dvec3 force(0.0);
    const glm::dvec3 velocity_mm_per_s(6.0, 0.0, 0.0);
    for (std::size_t i = 0; i < engagement->count; ++i)
        force += engagement->patches[i].cutting_n_s_per_mm *
                 std::max(0.0, glm::dot(engagement->patches[i].normal, velocity_mm_per_s));
    const glm::dvec3 reference(-1.413717, -10.350001, -0.9);
    EXPECT_LT(glm::length(force - reference) / glm::length(reference), 0.02);
}

TEST(Engagement, OfAHeadThatIsNoBallPredictsTheReferenceForce) {
    const Bone bone = testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 6.0}, 0.1);
    auto engagement = std::make_unique<Engagement>();
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.4, 1.0));
    const glm::dvec3 velocity_mm_per_s(5.0, 2.0, -1.0);
    for (const HeadShape shape : {HeadShape::cylinder, HeadShape::cone, HeadShape::barrel, HeadShape::pear}) {
        const Burr burr{.diameter_mm = 2.0, .head = usual_head(shape, 2.0, 4.0)};
        EngagementProbe(burr, 0.1).sample(bone, glm::dvec3(0.0), axis, *engagement);
        glm::dvec3 force(0.0);
        double removal_mm3_per_s = 0.0;
        for (std::size_t i = 0; i < engagement->count; ++i) {
            const EngagedPatch& patch = engagement->patches[i];
            const double advance = std::max(0.0, glm::dot(patch.normal, velocity_mm_per_s));
            force += patch.cutting_n_s_per_mm * advance;
            removal_mm3_per_s += patch.area_mm2 * advance;
        }
        const study::SteadyMotion motion{
            .burr = burr, .spindle_axis = axis, .velocity_mm_per_s = velocity_mm_per_s};
        const auto everywhere = [](const glm::dvec3&) { return 1.0; };
        const glm::dvec3 reference = study::mean_reference_force_n(motion, everywhere);
        EXPECT_LT(glm::length(force - reference) / glm::length(reference), 0.02) << static_cast<int>(shape);
        EXPECT_NEAR(removal_mm3_per_s / study::reference_removal_mm3_per_s(motion, everywhere), 1.0, 0.02);
    }
}

TEST(Engagement, GapOfAHeadThatIsNoBallIsTheDistanceToAFlatSurface) {
    const Bone bone = flat_block();
    auto engagement = std::make_unique<Engagement>();
    // The face of an upright cylinder: every patch of it is as far from the bone.
    const Burr burr{.diameter_mm = 3.0, .head = usual_head(HeadShape::cylinder, 3.0, 6.0)};
    EngagementProbe probe(burr, 0.1);
    for (const double height_mm : {0.09, 0.03, -0.05}) {
        probe.sample(bone, {0.0, 0.0, 1.5 + height_mm}, up, *engagement);
        double face_mm2 = 0.0;
        for (std::size_t i = 0; i < engagement->count; ++i) {
            const EngagedPatch& patch = engagement->patches[i];
            if (patch.normal.z > -0.9999) continue;
            EXPECT_NEAR(patch.gap_mm, height_mm, 0.02);
            face_mm2 += patch.area_mm2;
        }
        EXPECT_NEAR(face_mm2, std::numbers::pi * 1.2 * 1.2, 0.6);
    }
    probe.sample(bone, {0.0, 0.0, 2.0}, up, *engagement);
    EXPECT_EQ(engagement->count, 0U);
}

TEST(Engagement, SaysWithWhatForceEdgesRub) {
    // The same slot at half immersion: the advancing patches add up to the reference's edge force.
    const Bone bone = testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 0.0}, 0.1);
    Burr burr{.cutting_coefficients_n_per_mm2 = glm::dvec3(0.0)};
    auto engagement = std::make_unique<Engagement>();
    EngagementProbe(burr, 0.1).sample(bone, glm::dvec3(0.0), up, *engagement);
    EXPECT_FALSE(engagement->has_edge_force);
    burr.edge_coefficients_n_per_mm = {0.5, 0.4, 0.1};
    EngagementProbe(burr, 0.1).sample(bone, glm::dvec3(0.0), up, *engagement);
    EXPECT_TRUE(engagement->has_edge_force);
    // A quarter of a patch aside, so that no patch lies on the edge of the half that cuts.
    const double aside_rad = 2.0 * std::numbers::pi / 64.0;
    const glm::dvec3 velocity_mm_per_s(6.0 * std::cos(aside_rad), 6.0 * std::sin(aside_rad), 0.0);
    glm::dvec3 force(0.0);
    for (std::size_t i = 0; i < engagement->count; ++i)
        if (glm::dot(engagement->patches[i].normal, velocity_mm_per_s) > 0.0)
            force += engagement->patches[i].edge_n;
    const glm::dvec3 reference = study::mean_reference_force_n(
        {.burr = burr, .velocity_mm_per_s = velocity_mm_per_s}, study::flat_bone());
    EXPECT_LT(glm::length(force - reference) / glm::length(reference), 0.03);
}

TEST(Engagement, PlungingAlongTheSpindlePushesNothingSideways) {
    // Off the lattice, into flat bone: whole rings touch.
    const Bone bone = flat_block();
    auto engagement = std::make_unique<Engagement>();
    for (const double diameter_mm : {1.0, 2.3, 5.0}) {
        const Burr burr{.diameter_mm = diameter_mm};
        EngagementProbe probe(burr, 0.1);
        for (const double depth_mm : {0.12, 0.31, 0.45 * diameter_mm}) {
            probe.sample(bone, {0.031, 0.017, burr.radius_mm() - depth_mm}, up, *engagement);
            glm::dvec3 force(0.0);
            for (std::size_t i = 0; i < engagement->count; ++i) {
                const EngagedPatch& patch = engagement->patches[i];
                if (patch.gap_mm < 0.02) force += patch.cutting_n_s_per_mm * std::max(0.0, -patch.normal.z);
            }
            EXPECT_GT(force.z, 0.0);
            EXPECT_LT(glm::length(glm::dvec2(force)), 0.03 * force.z) << diameter_mm << ", " << depth_mm;
        }
    }
}

TEST(Engagement, SeesAShallowCutAtTheTipInSeveralRings) {
    // A cap 0.12 mm deep of a 5 mm burr, all of it: its area, and how far up it reaches, within a ring.
    const Bone bone = flat_block();
    const Burr burr{.diameter_mm = 5.0};
    auto engagement = std::make_unique<Engagement>();
    EngagementProbe(burr, 0.1).sample(bone, {0.031, 0.017, 2.5 - 0.12}, up, *engagement);
    double area_mm2 = 0.0;
    for (std::size_t i = 0; i < engagement->count; ++i)
        if (engagement->patches[i].gap_mm < 0.0) area_mm2 += engagement->patches[i].area_mm2;
    EXPECT_NEAR(area_mm2, 2.0 * std::numbers::pi * 2.5 * 0.12, 0.3);
}

TEST(Engagement, SeesTheLastOfAWallOfThreeVoxels) {
    // A burr goes through a wall: what the map says the next step removes, beside what it does remove.
    const Burr burr{.diameter_mm = 5.0};
    constexpr double half_mm = 0.15;
    constexpr double step_mm = 0.01;
    ForgottenChanges changes;
    auto result = std::make_unique<MillingResult>();
    const auto wall_mm = [=](const glm::dvec3& p) { return half_mm - std::abs(p.y); };
    MillingModel model(testing::make_block({-3.0, -1.0, -3.0}, {3.0, 1.0, 0.0}, 0.1, wall_mm), {burr}, {});
    double predicted_mm3 = 0.0;
    double removed_mm3 = 0.0;
    double missed_mm3 = 0.0;
    double expected_mm3 = 0.0;
    for (double y = -3.0; y < 0.5; y += step_mm) {
        model.step({.pose = {{0.031, y, 1.5}, up}, .spindle_on = true, .elapsed_s = 0.001}, 0.0, changes,
                   *result);
        predicted_mm3 += expected_mm3;
        removed_mm3 += result->removed_mm3;
        missed_mm3 += std::abs(expected_mm3 - result->removed_mm3);
        expected_mm3 = 0.0;
        for (std::size_t i = 0; i < result->engagement.count; ++i) {
            const EngagedPatch& patch = result->engagement.patches[i];
            expected_mm3 +=
                patch.area_mm2 * std::max(0.0, patch.normal.y * step_mm - std::max(0.0, patch.gap_mm));
        }
    }
    // By half of the fraction alone it was 0.42, since bone thinner than a voxel was not seen.
    EXPECT_NEAR(predicted_mm3 / removed_mm3, 0.8, 0.15);
    EXPECT_LT(missed_mm3 / removed_mm3, 0.35);
}

TEST(Engagement, IsTheSameWhereWhatIsInsideACarvedBurrIsPassedOver) {
    Bone bone = flat_block();
    const Burr burr{.diameter_mm = 3.0};
    MillingModel model(bone, {burr}, {});
    ForgottenChanges changes;
    auto result = std::make_unique<MillingResult>();
    for (int i = 0; i <= 20; ++i)
        model.step({.pose = {{0.031 + 0.02 * i, 0.017, 1.0}, up}, .spindle_on = true, .elapsed_s = 0.001},
                   0.0, changes, *result);
    auto any = std::make_unique<Engagement>();
    EngagementProbe(burr, 0.1).sample(model.bone(), result->pose.position_mm, up, *any);
    const Engagement& carved = result->engagement;
    ASSERT_GT(any->count, 100U);
    // Beside rims the map of a burr that has carved has thinner bone, too.
    ASSERT_GE(carved.count, any->count);
    std::size_t same = 0;
    for (std::size_t i = 0, k = 0; i < any->count; ++i, ++k) {
        while (k + 1 < carved.count && carved.patches[k].normal != any->patches[i].normal) ++k;
        ASSERT_EQ(carved.patches[k].normal, any->patches[i].normal);
        EXPECT_LE(carved.patches[k].area_mm2, any->patches[i].area_mm2);
        if (carved.patches[k].area_mm2 < any->patches[i].area_mm2) continue;
        EXPECT_EQ(carved.patches[k].gap_mm, any->patches[i].gap_mm);
        ++same;
    }
    EXPECT_GT(same, any->count / 2);
}

TEST(PatchCrossings, AreTheSameWithEveryInstructionSet) {
    const Bone bone = flat_block();
    const std::vector<BurrPatch> patches = burr_patches(Burr{.diameter_mm = 5.0}, 0.1);
    const glm::dvec3 centre = to_voxel_coordinates(bone.grid(), {0.031, 0.017, 1.9});
    BrickNeighbourhood bricks(30.0);
    ASSERT_TRUE(bricks.gather(bone, centre, 28.0));
    PatchCrossings plain(patches, 0.1, InstructionSet::plain);
    PatchCrossings best(patches, 0.1);
    const auto find = [&](PatchCrossings& crossings) {
        return crossings.find(bricks, glm::mat3(1.0f), glm::vec3(centre - glm::dvec3(bricks.base())), 25.0f,
                              InsideBurr::any);
    };
    const auto a = find(plain);
    const auto b = find(best);
    ASSERT_GT(a.size(), 50U);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].patch, b[i].patch);
        EXPECT_EQ(a[i].offset_voxels, b[i].offset_voxels);
    }
}

}  // namespace
}  // namespace osteomill::engagement_probe_test
