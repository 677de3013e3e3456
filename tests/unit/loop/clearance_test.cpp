#include "simulation/loop/clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "simulation/engagement/engagement_probe.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

/// The milling result of a 2 mm burr at `burr_mm`, at a block whose top is z = 0.
std::unique_ptr<MillingResult> seen_from(const glm::dvec3& burr_mm) {
    const Bone block = testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 0.0}, 0.1);
    const Burr burr{.name = "2 mm", .diameter_mm = 2.0, .spindle_rev_per_s = 500.0};
    auto result = std::make_unique<MillingResult>();
    result->step = 1;
    result->pose.position_mm = burr_mm;
    EngagementProbe(burr, 0.1).sample(block, burr_mm, {0.0, 0.0, 1.0}, result->engagement);
    return result;
}

TEST(Clearance, IsKnownInAirAndOnTheSurface) {
    for (const double z_mm : {5.0, 1.3, 1.1, 1.0}) {
        const glm::dvec3 burr_mm(0.0, 0.0, z_mm);
        EXPECT_EQ(Clearance::clear, clearance_of(*seen_from(burr_mm), burr_mm)) << z_mm;
    }
}

TEST(Clearance, IsNotInsideTheBoneHoweverDeep) {
    for (const double z_mm : {0.95, 0.5, 0.0, -1.0, -2.0}) {
        const glm::dvec3 burr_mm(0.0, 0.0, z_mm);
        EXPECT_EQ(Clearance::in_bone, clearance_of(*seen_from(burr_mm), burr_mm)) << z_mm;
    }
}

TEST(Clearance, FollowsABurrOnlyAsFarAsTheMapSees) {
    const auto above = seen_from({0.0, 0.0, 1.05});
    EXPECT_EQ(Clearance::clear, clearance_of(*above, {0.0, 0.0, 1.1}));
    EXPECT_EQ(Clearance::in_bone, clearance_of(*above, {0.0, 0.0, 0.95}));
    EXPECT_EQ(Clearance::unknown, clearance_of(*above, {0.0, 0.0, 3.0})) << "free as it may be there";
    EXPECT_EQ(Clearance::unknown, clearance_of(*above, {NAN, 0.0, 1.05}));
}

TEST(Clearance, IsNotWhereBoneReachesIntoTheShank) {
    const Bone block = testing::make_block({0.0, -4.0, 2.0}, {4.0, 4.0, 8.0}, 0.1);
    Burr burr{.name = "2 mm", .diameter_mm = 2.0};
    const auto at = [&](double x_mm) {
        auto result = std::make_unique<MillingResult>();
        result->step = 1;
        result->pose.position_mm = {x_mm, 0.0, 0.0};
        EngagementProbe(burr, 0.1).sample(block, result->pose.position_mm, {0.0, 0.0, 1.0},
                                          result->engagement);
        return clearance_of(*result, result->pose.position_mm);
    };
    EXPECT_EQ(Clearance::clear, at(-0.3)) << "the burr is below the bone";
    burr.shank = {{1.2, 0.4}, {8.0, 0.4}};
    EXPECT_EQ(Clearance::in_bone, at(-0.3));
    EXPECT_EQ(Clearance::clear, at(-0.41));
}

TEST(Clearance, TakesTheWordOfAModelWithoutAMap) {
    MillingResult result;
    EXPECT_EQ(Clearance::unknown, clearance_of(result, glm::dvec3(0.0))) << "there is no result yet";
    result.step = 1;
    EXPECT_EQ(Clearance::clear, clearance_of(result, glm::dvec3(0.0)));
    result.has_bone_inside = true;
    EXPECT_EQ(Clearance::in_bone, clearance_of(result, glm::dvec3(0.0)));
}

}  // namespace
}  // namespace osteomill
