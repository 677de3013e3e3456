#include "studies/force/random_motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill::study {
namespace {

TEST(RandomMotions, CoverWhatIsPromised) {
    const auto motions = random_motions(2000, 5);
    ASSERT_EQ(motions.size(), 2000u);
    const auto count = [&](auto&& is) {
        return static_cast<double>(std::count_if(motions.begin(), motions.end(), is));
    };
    for (const RandomMotion& m : motions) {
        const SteadyCase& c = m.motion;
        EXPECT_GE(c.burr.diameter_mm, 1.0);
        EXPECT_LE(c.burr.diameter_mm, 5.0);
        EXPECT_GE(c.depth_mm, 0.1 - 1e-9);
        EXPECT_LE(c.depth_mm, c.burr.radius_mm() + 1e-9);
        EXPECT_NEAR(glm::length(c.spindle_axis), 1.0, 1e-9) << c.name;
        EXPECT_NEAR(glm::dot(c.spindle_axis, c.up), std::cos(m.tilt_deg * 3.14159265358979 / 180.0), 1e-9);
        EXPECT_LE(m.tilt_deg, 70.0);
        EXPECT_GE(glm::length(c.velocity_mm_per_s), 0.2 - 1e-9);
        EXPECT_LE(glm::length(c.velocity_mm_per_s), 60.0 + 1e-9);
        const double climb = glm::dot(c.velocity_mm_per_s, c.up);
        EXPECT_TRUE(m.dives ? climb < 0.0 : std::abs(climb) < 1e-9) << c.name;
        if (c.previous_groove_mm_higher) {
            EXPECT_LE(*c.previous_groove_mm_higher, c.depth_mm + 1e-9) << c.name;
            EXPECT_FALSE(m.dives) << c.name;
        }
    }
    EXPECT_NEAR(count([](const RandomMotion& m) { return m.dives; }), 667, 100);
    EXPECT_NEAR(count([](const RandomMotion& m) { return m.motion.previous_groove_mm_higher.has_value(); }),
                444, 100);
    EXPECT_NEAR(count([](const RandomMotion& m) { return m.motion.burr.sense == SpindleSense::clockwise; }),
                1000, 120);
    EXPECT_GT(count([](const RandomMotion& m) { return m.motion.depth_mm < 0.3; }), 100);
    EXPECT_NEAR(count([](const RandomMotion& m) {
                    return glm::length(m.motion.velocity_mm_per_s) < std::sqrt(0.2 * 60.0);
                }),
                1000, 120)
        << "feeds are even in their logarithm";
}

TEST(RandomMotions, AreTheSameForTheSameSeedAndOthersForAnother) {
    const auto once = random_motions(20, 7);
    const auto again = random_motions(20, 7);
    const auto other = random_motions(20, 8);
    for (std::size_t i = 0; i < once.size(); ++i) {
        EXPECT_EQ(once[i].motion.name, again[i].motion.name);
        EXPECT_NE(once[i].motion.name, other[i].motion.name);
    }
    EXPECT_EQ(random_motions(5, 7).back().motion.name, once[4].motion.name) << "more only follow";
}

TEST(RandomMotions, OfADiveAreComparedWithTheMeanOverItsPath) {
    // The force of a shallow dive grows with the depth, faster than in proportion.
    RandomMotion dive{.motion = {.burr = {.diameter_mm = 3.0}, .velocity_mm_per_s = {4.0, 0.0, -3.0}},
                      .dives = true};
    dive.motion.depth_mm = 0.6;
    const glm::dvec3 reference_n = reference_over_path_n(dive);
    const glm::dvec3 half_way_n = mean_reference_force_n(motion_of(dive.motion), bone_of(dive.motion));
    EXPECT_GT(glm::distance(reference_n, half_way_n), 1e-4 * glm::length(half_way_n));
    EXPECT_LT(relative_error(mean_force_n(run_steady(dive.motion, dive.run, voxel_model())), reference_n),
              0.02);
}

}  // namespace
}  // namespace osteomill::study
