#include "common/scene/burr_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace osteomill {
namespace {

struct Head {
    BurrHead head;
    double diameter_mm;
};

std::vector<Head> heads() {
    return {{{}, 3.0},
            {usual_head(HeadShape::cylinder, 1.2, 4.0), 1.2},
            {usual_head(HeadShape::cone, 2.0, 5.0), 2.0},
            {{HeadShape::cone, 2.0, 3.0, 1.2}, 3.0},
            {usual_head(HeadShape::barrel, 4.0, 6.0), 4.0},
            {{HeadShape::barrel, 3.0, 1.0, 2.5}, 3.0},
            {usual_head(HeadShape::pear, 2.5, 5.0), 2.5}};
}

TEST(BurrProfile, HasThePointsOffItsOutlineAtTheirDistance) {
    for (const Head& h : heads()) {
        const BurrProfile profile(h.head, h.diameter_mm);
        for (int i = 1; i < 200; ++i) {
            const OutlinePoint p = profile.outline_at(profile.outline_length() * i / 200);
            EXPECT_NEAR(std::hypot(p.out, p.up), 1.0, 1e-12);
            for (const double off : {-0.05 * h.diameter_mm, 0.0, 0.3, 2.0}) {
                const double radius = p.radius + off * p.out;
                if (radius < 0.0) continue;
                const NearestSurface nearest = profile.nearest(radius, p.height + off * p.up);
                EXPECT_NEAR(nearest.distance, off, 1e-9) << i;
                if (off == 0.0) continue;
                EXPECT_NEAR(nearest.out * p.out + nearest.up * p.up, 1.0, 1e-9) << i;
            }
        }
    }
}

TEST(BurrProfile, RunsFromTheSpindleToTheSpindleWithTheHeadsSizes) {
    for (const Head& h : heads()) {
        const BurrProfile profile(h.head, h.diameter_mm);
        const OutlinePoint tip = profile.outline_at(0.0);
        const OutlinePoint top = profile.outline_at(profile.outline_length());
        EXPECT_NEAR(tip.radius, 0.0, 1e-12);
        EXPECT_NEAR(tip.height, -0.5 * h.diameter_mm, 1e-12) << "half a diameter below the origin";
        EXPECT_NEAR(tip.up, -1.0, 1e-12);
        EXPECT_NEAR(top.radius, 0.0, 1e-12);
        EXPECT_NEAR(top.up, 1.0, 1e-12);
        const double length_mm = h.head.shape == HeadShape::ball ? h.diameter_mm : h.head.length_mm;
        EXPECT_NEAR(top.height - tip.height, length_mm, 1e-12);
        double widest = 0.0;
        for (int i = 0; i <= 4000; ++i)
            widest = std::max(widest, profile.outline_at(profile.outline_length() * i / 4000).radius);
        EXPECT_NEAR(widest, 0.5 * h.diameter_mm, 1e-5 * h.diameter_mm);
        EXPECT_EQ(profile.largest_radius(), 0.5 * h.diameter_mm);
    }
}

TEST(BurrProfile, ReachesAsFarAsItsOutline) {
    for (const Head& h : heads()) {
        const BurrProfile profile(h.head, h.diameter_mm);
        const double middle = 0.5 * (profile.tip_height() + profile.top_height());
        for (const double angle : {0.0, 0.4, 1.1, 1.6, 2.4, 3.1}) {
            const glm::dvec3 direction(std::sin(angle) * 0.6, std::sin(angle) * 0.8, -std::cos(angle));
            double farthest = -1e9;
            for (int i = 0; i <= 4000; ++i) {
                const OutlinePoint p = profile.outline_at(profile.outline_length() * i / 4000);
                farthest = std::max(farthest, p.radius * std::sin(angle) + p.height * direction.z);
                EXPECT_LE(std::hypot(p.radius, p.height - middle), profile.bounding_radius() + 1e-9);
            }
            EXPECT_NEAR(profile.reach_along(direction), farthest, 1e-5 * h.diameter_mm);
        }
    }
}

TEST(BurrProfile, IsAsLargeAsItsScale) {
    const BurrHead head = usual_head(HeadShape::barrel, 2.0, 4.0);
    const BurrProfile in_mm(head, 2.0);
    const BurrProfile in_voxels(head, 2.0, 10.0);
    EXPECT_NEAR(in_voxels.nearest(13.0, 21.0).distance, 10.0 * in_mm.nearest(1.3, 2.1).distance, 1e-9);
    EXPECT_NEAR(in_voxels.outline_length(), 10.0 * in_mm.outline_length(), 1e-9);
}

TEST(BurrHead, RefusesWhatIsNoHead) {
    const auto refuses = [](const BurrHead& head) {
        EXPECT_THROW(require_valid(head, 2.0), std::invalid_argument);
    };
    refuses({HeadShape::ball, 3.0, 0.0, 0.0});
    refuses({HeadShape::cylinder, 0.5, 2.0, 2.0});
    refuses({HeadShape::cylinder, 31.0, 2.0, 2.0});
    refuses({HeadShape::cylinder, 4.0, 1.9, 2.0});
    refuses({HeadShape::cone, 4.0, 1.0, 1.9});
    refuses({HeadShape::cone, 4.0, 0.5, 2.0});
    refuses({HeadShape::barrel, 4.0, 2.1, 1.0});
    refuses({HeadShape::barrel, std::nan(""), 1.0, 1.0});
    refuses({HeadShape::pear, 1.9, 0.0, 1.0});
    refuses({HeadShape::pear, 4.0, 1.0, 1.0});
    for (const Head& h : heads()) EXPECT_NO_THROW(require_valid(h.head, h.diameter_mm));
}

}  // namespace
}  // namespace osteomill
