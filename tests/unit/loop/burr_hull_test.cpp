#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/burr_profile.h"
#include "simulation/loop/clearance.h"

namespace osteomill {
namespace {

bool holds(const std::vector<HullBall>& hull, double radius_mm, double height_mm) {
    return std::ranges::any_of(hull, [&](const HullBall& ball) {
        return std::hypot(radius_mm, height_mm - ball.height_mm) <= ball.radius_mm + 1e-9;
    });
}

TEST(BurrHull, OfABallIsTheBall) {
    const auto hull = burr_hull({.diameter_mm = 3.0});
    ASSERT_EQ(hull.size(), 1U);
    EXPECT_EQ(hull[0].radius_mm, 1.5);
    EXPECT_EQ(hull[0].height_mm, 0.0);
}

TEST(BurrHull, HoldsHeadAndShank) {
    for (const HeadShape shape : {HeadShape::ball, HeadShape::cylinder, HeadShape::cone, HeadShape::pear}) {
        Burr burr{.diameter_mm = 2.0, .head = usual_head(shape, 2.0, 6.0)};
        burr.shank = {{1.5, 0.4}, {6.0, 0.5}, {8.0, 1.2}, {40.0, 9.0}};
        const auto hull = burr_hull(burr);
        const BurrProfile head(burr.head, 2.0);
        for (int i = 0; i <= 300; ++i) {
            const OutlinePoint p = head.outline_at(head.outline_length() * i / 300);
            EXPECT_TRUE(holds(hull, p.radius, p.height)) << p.radius << ' ' << p.height;
        }
        for (std::size_t cone = 0; cone + 1 < burr.shank.size(); ++cone)
            for (int i = 0; i <= 100; ++i) {
                const double share = i / 100.0;
                const auto between = [&](double a, double b) { return a + share * (b - a); };
                EXPECT_TRUE(holds(hull, between(burr.shank[cone].radius_mm, burr.shank[cone + 1].radius_mm),
                                  between(burr.shank[cone].height_mm, burr.shank[cone + 1].height_mm)));
            }
        EXPECT_FALSE(holds(hull, 3.0, 2.0)) << "no more than it must";
    }
}

}  // namespace
}  // namespace osteomill
