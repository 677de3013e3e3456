#include "simulation/cutting_force/reference_force.h"

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

glm::dvec3 mean_over_a_tooth_period(const SteadyMotion& motion, double helix_lag_rad_per_mm) {
    constexpr int instants = 240;
    glm::dvec3 mean(0.0);
    for (int j = 0; j < instants; ++j)
        mean += instantaneous_reference_force_n(
                    motion, flat_bone(), 2.0 * std::numbers::pi / motion.burr.edges * (j + 0.5) / instants,
                    helix_lag_rad_per_mm) /
                static_cast<double>(instants);
    return mean;
}

TEST(ReferenceForceInstants, AverageToTheMean) {
    SteadyMotion motion = slot_1_mm_deep();
    for (const glm::dvec3 edges : {glm::dvec3(0.0), glm::dvec3(0.3, 0.2, 0.1)})
        for (const double helix_lag_rad_per_mm : {0.0, 0.2}) {
            motion.burr.edge_coefficients_n_per_mm = edges;
            const glm::dvec3 mean = mean_reference_force_n(motion, flat_bone());
            EXPECT_LT(glm::length(mean_over_a_tooth_period(motion, helix_lag_rad_per_mm) - mean) /
                          glm::length(mean),
                      2e-3);
        }
}

TEST(ReferenceForce, OfEdgesIsThatOfTheSlotsFormula) {
    // N_phi / 2 pi times the integral of (K_te, K_re, K_ae) R dkappa dpsi over the half that faces the feed.
    SteadyMotion motion = slot_1_mm_deep();
    motion.burr.cutting_coefficients_n_per_mm2 = glm::dvec3(0.0);
    motion.burr.edge_coefficients_n_per_mm = {0.5, 0.4, 0.1};
    const double radius = motion.burr.radius_mm();
    const double k = std::acos(1.0 - 1.0 / radius);
    const double per_turn = motion.burr.edges * radius / (2.0 * std::numbers::pi);
    const glm::dvec3 expected(-2.0 * per_turn * (0.4 * (1.0 - std::cos(k)) + 0.1 * std::sin(k)),
                              -2.0 * per_turn * 0.5 * k,
                              std::numbers::pi * per_turn * (0.4 * std::sin(k) - 0.1 * (1.0 - std::cos(k))));
    const glm::dvec3 force = mean_reference_force_n(motion, flat_bone());
    EXPECT_LT(glm::length(force - expected) / glm::length(expected), 1e-3)
        << force.x << ' ' << force.y << ' ' << force.z;
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
    motion.burr.edge_coefficients_n_per_mm = {1.0, 0.0, 0.0};
    motion.position_mm.z = 5.0;  // in air
    EXPECT_EQ(mean_reference_force_n(motion, flat_bone()), glm::dvec3(0.0));
    motion.velocity_mm_per_s = {0.0, 0.0, 0.0};
    EXPECT_EQ(mean_reference_force_n(motion, flat_bone()), glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill::study
