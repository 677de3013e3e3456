// Sites and walks are well made: they have bone at the stated places, and a hand that starts clear of it and
// cuts some.
#include "studies/stability/sites/named_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>
#include <string>

#include "studies/stability/sites/site.h"

namespace osteomill::study::named_sites_test {
namespace {

/// The least distance from the burr's surface to bone along a motion, and at its start, mm; on a lattice of
/// points of the burr's surface.
struct Reach {
    double at_start_mm = 1e9;
    double least_mm = 1e9;
};

double distance_to_burr_mm(const Site& site, const glm::dvec3& centre_mm) {
    // The shapes' distances are exact outside but at edges, and never too large: good enough to tell air from
    // bone.
    return site.shape.distance_mm(centre_mm) - site.burr.radius_mm();
}

Reach reach_of(const Site& site) {
    Reach reach{.at_start_mm = distance_to_burr_mm(site, site.motion.front().pose.position_mm)};
    for (std::size_t i = 1; i < site.motion.size(); ++i)
        for (int step = 0; step <= 20; ++step) {
            const glm::dvec3 from = site.motion[i - 1].pose.position_mm;
            const glm::dvec3 to = site.motion[i].pose.position_mm;
            reach.least_mm =
                std::min(reach.least_mm, distance_to_burr_mm(site, from + (to - from) * (step / 20.0)));
        }
    return reach;
}

bool holds(const SiteShape& shape, const glm::dvec3& position_mm, double radius_mm) {
    const glm::dvec3 low = glm::min(shape.low_mm, position_mm - radius_mm);
    const glm::dvec3 high = glm::max(shape.high_mm, position_mm + radius_mm);
    // Above bone's top there may be air outside the box.
    return low.x == shape.low_mm.x && low.y == shape.low_mm.y && high.x == shape.high_mm.x &&
           high.y == shape.high_mm.y;
}

TEST(NamedSites, AreOfTenKindsAndHaveNamesOfTheirOwn) {
    std::set<std::string> kinds;
    std::set<std::string> names;
    const auto sites = named_sites({.diameter_mm = 5.0});
    for (const Site& site : sites) {
        kinds.insert(site.kind);
        names.insert(site.name);
    }
    EXPECT_EQ(kinds.size(), 10U);
    EXPECT_EQ(names.size(), sites.size());
}

TEST(NamedSites, BeginInAirAndCutBone) {
    for (const double diameter_mm : {1.0, 3.0, 5.0})
        for (const Site& site : named_sites({.diameter_mm = diameter_mm})) {
            const Reach reach = reach_of(site);
            EXPECT_GT(reach.at_start_mm, 0.2) << site.name << ", " << diameter_mm;
            EXPECT_LT(reach.least_mm, 0.0) << site.name << ", " << diameter_mm;
            for (const Waypoint& waypoint : site.motion)
                EXPECT_TRUE(holds(site.shape, waypoint.pose.position_mm, 0.0)) << site.name;
        }
}

TEST(TiltsInHoles, LeaveTheHeadRoomAndLeanAsTheySay) {
    const auto sites = tilts_in_holes();
    EXPECT_GE(sites.size(), 24U);
    for (const Site& site : sites) {
        const Reach reach = reach_of(site);
        EXPECT_GT(reach.at_start_mm, 0.02) << site.name;
        EXPECT_GT(reach.least_mm, 0.0) << site.name << ": upright the head cuts nothing";
        double least_cosine = 1.0;
        for (const Waypoint& waypoint : site.motion)
            least_cosine = std::min(least_cosine, waypoint.pose.spindle_axis.z);
        EXPECT_LT(least_cosine, 0.998) << site.name;
        EXPECT_FALSE(site.burr.shank.empty());
    }
}

TEST(RandomWalk, IsTheSameForASeedAndANumberAndNoOther) {
    const Site walk = random_walk(7, 3);
    const Site again = random_walk(7, 3);
    const Site another = random_walk(7, 4);
    EXPECT_EQ(walk.name, again.name);
    EXPECT_EQ(walk.motion.back().pose.position_mm, again.motion.back().pose.position_mm);
    EXPECT_NE(walk.motion.back().pose.position_mm, another.motion.back().pose.position_mm);
    EXPECT_NE(walk.burr.diameter_mm, random_walk(8, 3).burr.diameter_mm);
}

TEST(RandomWalk, StaysWithinItsBoundsAndBeginsInAir) {
    int cutting = 0;
    for (int number = 1; number <= 40; ++number) {
        const Site walk = random_walk(1, number);
        EXPECT_GE(walk.burr.diameter_mm, 1.0);
        EXPECT_LE(walk.burr.diameter_mm, 5.0);
        const Reach reach = reach_of(walk);
        EXPECT_GT(reach.at_start_mm, 0.2) << walk.name;
        cutting += reach.least_mm < 0.0 ? 1 : 0;
        for (std::size_t i = 3; i < walk.motion.size(); ++i) {
            const double speed_mm_per_s =
                glm::distance(walk.motion[i].pose.position_mm, walk.motion[i - 1].pose.position_mm) /
                (walk.motion[i].time_s - walk.motion[i - 1].time_s);
            ASSERT_LE(speed_mm_per_s, 1.01 * fastest_walk_mm_per_s) << walk.name;
        }
    }
    EXPECT_GT(cutting, 30) << "a few walks beside a ridge or a corner meet nothing";
}

}  // namespace
}  // namespace osteomill::study::named_sites_test
