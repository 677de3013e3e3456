#include "studies/force/reference_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/support/reference_cases.h"

namespace osteomill::study {
namespace {

using testing::ReferenceCase;

class AgainstTable : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(AgainstTable, AgreesWithTheIndependentQuadrature) {
    const ReferenceCase& c = GetParam();
    const glm::dvec3 force = mean_reference_force_n(motion_of(c), bone_of(c));
    // At 0.25 mm the tabulated quadrature is itself 0.2 % off the closed form; see the next test.
    const double tolerance = c.depth_mm < 0.3 ? 4e-3 : 1e-3;
    EXPECT_LT(glm::length(force - c.mean_force_n) / glm::length(c.mean_force_n), tolerance)
        << force.x << ' ' << force.y << ' ' << force.z;
    EXPECT_NEAR(reference_removal_mm3_per_s(motion_of(c), bone_of(c)) / c.removal_mm3_per_s, 1.0, tolerance);
}

INSTANTIATE_TEST_SUITE_P(ReferenceForce, AgainstTable, ::testing::ValuesIn(testing::reference_cases()),
                         [](const auto& test) {
                             std::string name = test.param.name;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

TEST(ReferenceForce, MeetsTheClosedFormOfAFreshSlot) {
    // F_x = -(fr/4) (K_r Is + K_a Ic), |F_y| = (fr/4) K_t d, F_z = (fr/pi) (K_r Ic - K_a Is), fr = |v| /
    // n_rev.
    for (const double depth_mm : {0.05, 0.25, 1.0, 2.5, 4.0}) {
        const SteadyMotion motion{.burr = {.name = "5 mm", .sense = SpindleSense::counter_clockwise},
                                  .position_mm = {0.0, 0.0, 2.5 - depth_mm},
                                  .velocity_mm_per_s = {6.0, 0.0, 0.0}};
        const double kd = std::acos(1.0 - depth_mm / 2.5);
        const double is = 2.5 * (kd / 2.0 - std::sin(2.0 * kd) / 4.0);
        const double ic = 2.5 * std::sin(kd) * std::sin(kd) / 2.0;
        const double fr = 6.0 / motion.burr.spindle_rev_per_s;
        const glm::dvec3 exact(-fr / 4.0 * (40.0 * is + 20.0 * ic), -fr / 4.0 * 230.0 * depth_mm,
                               fr / std::numbers::pi * (40.0 * ic - 20.0 * is));
        const glm::dvec3 force = mean_reference_force_n(motion, flat_bone());
        EXPECT_LT(glm::length(force - exact) / glm::length(exact), 1e-4) << depth_mm << " mm";
    }
}

SteadyMotion slot_1_mm_deep() {
    return {.burr = {.name = "5 mm", .sense = SpindleSense::counter_clockwise},
            .position_mm = {0.0, 0.0, 1.5},
            .velocity_mm_per_s = {6.0, 0.0, 0.0}};
}

glm::dvec3 mean_over_a_tooth_period(const SteadyMotion& motion, const EdgeDetails& details) {
    constexpr int instants = 240;
    glm::dvec3 mean(0.0);
    for (int j = 0; j < instants; ++j)
        mean += instantaneous_reference_force_n(
                    motion, flat_bone(), 2.0 * std::numbers::pi / motion.burr.edges * (j + 0.5) / instants,
                    details) /
                static_cast<double>(instants);
    return mean;
}

TEST(ReferenceForceInstants, AverageToTheMean) {
    const SteadyMotion motion = slot_1_mm_deep();
    for (const EdgeDetails& details :
         {EdgeDetails{}, EdgeDetails{.helix_lag_rad_per_mm = 0.2, .edge_force_n_per_mm = {0.3, 0.2, 0.1}}}) {
        const glm::dvec3 mean = mean_reference_force_n(motion, flat_bone(), details);
        EXPECT_LT(glm::length(mean_over_a_tooth_period(motion, details) - mean) / glm::length(mean), 2e-3);
    }
}

TEST(ReferenceForceInstants, RipplesWithTheToothPeriodAndLessWithMoreEdges) {
    SteadyMotion motion = slot_1_mm_deep();
    const auto ripple = [&] {
        double low = 1e300;
        double high = 0.0;
        for (int j = 0; j < 60; ++j) {
            const double turned = 2.0 * std::numbers::pi / motion.burr.edges * j / 60.0;
            const double force = glm::length(instantaneous_reference_force_n(motion, flat_bone(), turned));
            low = std::min(low, force);
            high = std::max(high, force);
        }
        return high - low;
    };
    const double few = ripple();
    EXPECT_GT(few, 0.001);
    motion.burr.edges = 24;
    EXPECT_LT(ripple(), 0.5 * few);
    const double period = 2.0 * std::numbers::pi / motion.burr.edges;
    EXPECT_NEAR(glm::length(instantaneous_reference_force_n(motion, flat_bone(), 0.1) -
                            instantaneous_reference_force_n(motion, flat_bone(), 0.1 + period)),
                0.0, 1e-9);
}

TEST(ReferenceForceInstants, EdgeForcesPushOnlyWhereAnEdgeCuts) {
    SteadyMotion motion = slot_1_mm_deep();
    const EdgeDetails details{.edge_force_n_per_mm = {1.0, 0.0, 0.0}};
    motion.position_mm.z = 5.0;  // in air
    EXPECT_EQ(mean_reference_force_n(motion, flat_bone(), details), glm::dvec3(0.0));
    motion.velocity_mm_per_s = {0.0, 0.0, 0.0};
    EXPECT_EQ(mean_reference_force_n(motion, flat_bone(), details), glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill::study
