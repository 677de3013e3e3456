#include "simulation/force_models/hertz_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/support/bone_variants.h"
#include "tests/unit/force_models/contact_bench.h"

namespace osteomill::hertz_contact_test {
namespace {

using testing::ContactBench;
using testing::five_mm;
using testing::wide_block;

double cap(double depth, double radius) {
    return std::numbers::pi * depth * depth * (radius - depth / 3.0);
}

/// A burr beside the face at x = 2.6 that looks along +x, its spindle along z.
glm::dvec3 beside(double depth_mm) {
    return {2.6 + 2.5 - depth_mm, 0.0, -1.1};
}

TEST(CapHeight, IsTheDepthOfTheCapThatHasTheVolume) {
    for (const double depth : {1e-3, 0.1, 1.0, 2.5, 4.0, 4.99})
        EXPECT_NEAR(cap_height(cap(depth, 2.5), 2.5), depth, 1e-6) << depth;
    EXPECT_NEAR(cap_height(0.0, 2.5), 0.0, 1e-12);
    EXPECT_NEAR(cap_height(100.0, 2.5), 5.0, 1e-9) << "no more than the whole ball";
}

TEST(HertzContact, PushesAsThePowerThreeHalvesOfTheDepth) {
    HertzContact law({.elasticity_n_per_mm2 = 3.0});
    ContactBench bench(wide_block());
    for (const double depth_mm : {0.3, 0.5, 0.75, 1.0}) {
        const double expected_n = 3.0 * 2.5 * 2.5 * std::pow(depth_mm / 2.5, 1.5);
        EXPECT_NEAR(glm::length(bench.pressed(law, depth_mm).force_n), expected_n, 0.01 * expected_n)
            << depth_mm << " mm deep";
    }
}

TEST(HertzContact, RubsAgainstTheSpinWithMuTimesThePush) {
    // At 0.1 mm the contact is 0.5 mm wide, and slip differs in direction by no more than 12 degrees.
    for (const double friction : {0.1, 0.3, 0.6}) {
        HertzContact law({.friction = friction});
        ContactBench bench(wide_block());
        const glm::dvec3 off = bench.at(law, beside(0.1), false).force_n;
        const glm::dvec3 on = bench.at(law, beside(0.1), true).force_n;
        EXPECT_NEAR(on.x, off.x, 1e-3 * off.x);
        // Clockwise seen from the shank, the side at -x moves along +y; bone holds it back.
        EXPECT_NEAR(on.y, -friction * off.x, 0.01 * friction * off.x);
        EXPECT_NEAR(on.z, 0.0, 0.01 * friction * off.x);
        EXPECT_NEAR(off.y, 0.0, 1e-3 * off.x) << "no spin, no friction";
    }
}

TEST(HertzContact, RubsTheOtherWayWhenTheBurrTurnsTheOtherWay) {
    HertzContact law;
    Burr burr = five_mm();
    ContactBench clockwise(wide_block(), burr);
    burr.sense = SpindleSense::counter_clockwise;
    ContactBench counter(wide_block(), burr);
    const glm::dvec3 one = clockwise.at(law, beside(0.3), true).force_n;
    const glm::dvec3 other = counter.at(law, beside(0.3), true).force_n;
    EXPECT_LT(one.y, -0.05);
    EXPECT_NEAR(other.y, -one.y, 1e-3);
    EXPECT_NEAR(other.x, one.x, 1e-3);
}

TEST(HertzContact, RubsAcrossATiltedSpindle) {
    HertzContact law({.friction = 0.3});
    ContactBench bench(wide_block());
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 0.0, 1.0));
    const glm::dvec3 on = bench.at(law, {0.0, 0.0, 2.5 - 0.1}, true, axis).force_n;
    // The point below the centre slips along r x w, r = -z, w = -axis (clockwise): along +y.
    EXPECT_NEAR(on.y / on.z, 0.3, 0.02);
    EXPECT_NEAR(on.x / on.z, 0.0, 0.01);
}

TEST(HertzContact, PushesAsHardAsTheBoneInContact) {
    HertzContact law;
    const auto push_n = [&](double stiffness) {
        ContactBench bench(testing::with_stiffness(wide_block(), stiffness));
        return bench.pressed(law, 0.5).force_n.z;
    };
    EXPECT_NEAR(push_n(0.4), 0.4 * push_n(1.0), 1e-9);
}

TEST(HertzContact, SpendsAllItsFrictionOnErosion) {
    const HertzSettings settings{.friction = 0.3, .erosion_mj_per_mm3 = 12.0};
    HertzContact law(settings);
    ContactBench bench(wide_block());
    const double depth_mm = 0.3;
    const double push_n = bench.at(law, beside(depth_mm), false).force_n.x;
    const double erosion_per_s = bench.at(law, beside(depth_mm), true).erosion_per_s;
    // The whole contact lies nearly R from the spindle's axis.
    const double power_mw =
        0.3 * push_n * 2.0 * std::numbers::pi * five_mm().spindle_rev_per_s * 2.5 * (1.0 - 0.25 * 0.3 / 2.5);
    EXPECT_NEAR(erosion_per_s * 12.0 * cap(depth_mm, 2.5), power_mw, 0.03 * power_mw);
    EXPECT_EQ(bench.at(law, beside(depth_mm), false).erosion_per_s, 0.0);
}

}  // namespace
}  // namespace osteomill::hertz_contact_test
