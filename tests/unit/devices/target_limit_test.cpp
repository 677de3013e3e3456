#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "devices/client/client_device.h"

namespace osteomill::target_limit_test {
namespace {

const glm::dvec3 burr{1.0, 2.0, 3.0};

TEST(TargetLimit, PassesWhatAHandDoes) {
    TargetLimit limit(burr);
    // To and fro within reach, 300 mm/s at the most, sixty times a second.
    for (int i = 0; i < 600; ++i) {
        const double t_s = i / 60.0;
        const glm::dvec3 wanted = burr + glm::dvec3(0.0, 0.0, 5.0 * std::sin(60.0 * t_s));
        EXPECT_EQ(limit.limited(wanted, burr, t_s), wanted) << "at " << t_s;
    }
    EXPECT_STREQ(limit.notice(), "");
}

TEST(TargetLimit, KeepsTargetsWithinReachOfTheBurr) {
    TargetLimit limit(burr);
    const glm::dvec3 target = limit.limited(burr + glm::dvec3(100.0, 0.0, 0.0), burr, 0.0);
    EXPECT_NEAR(glm::distance(target, burr + glm::dvec3(longest_reach_mm, 0.0, 0.0)), 0.0, 1e-12);
    EXPECT_NE(std::string(limit.notice()).find("6 mm from the burr"), std::string::npos);
    EXPECT_EQ(std::string(limit.notice()).find("faster"), std::string::npos);

    const double huge = std::numeric_limits<double>::max();
    EXPECT_LE(glm::distance(limit.limited({huge, -huge, huge}, burr, 1.0), burr), longest_reach_mm + 1e-9);
}

TEST(TargetLimit, AllowsNoLongerAPathThanAHandGoes) {
    TargetLimit limit(burr);
    double path_mm = 0.0;
    glm::dvec3 before = burr;
    for (int tick = 0; tick < 1000; ++tick) {  // from side to side a thousand times a second
        const double side_mm = tick % 2 == 0 ? 5.5 : -5.5;
        const glm::dvec3 target = limit.limited(burr + glm::dvec3(side_mm, 0.0, 0.0), burr, 0.001 * tick);
        path_mm += glm::distance(before, target);
        before = target;
    }
    EXPECT_LE(path_mm, fastest_hand_mm_per_s + TargetLimit::room_mm);
    EXPECT_GT(path_mm, 0.9 * fastest_hand_mm_per_s);
    EXPECT_NE(std::string(limit.notice()).find("500 mm/s"), std::string::npos);
}

TEST(TargetLimit, TakesNoOffenceAtMessagesThatComeLateAndAtOnce) {
    TargetLimit limit(burr);
    limit.limited(burr - glm::dvec3(5.9, 0.0, 0.0), burr, 0.0);
    limit.limited(burr + glm::dvec3(5.9, 0.0, 0.0), burr, 0.1);
    limit.limited(burr + glm::dvec3(5.8, 0.0, 0.0), burr, 0.1);
    EXPECT_STREQ(limit.notice(), "");
}

TEST(TargetLimit, NamesBothOnceBothWereClamped) {
    TargetLimit limit(burr);
    for (int i = 0; i < 10; ++i) limit.limited(burr + glm::dvec3(i % 2 == 0 ? 90.0 : -90.0, 0, 0), burr, 0.0);
    const std::string notice = limit.notice();
    EXPECT_NE(notice.find("6 mm"), std::string::npos);
    EXPECT_NE(notice.find("500 mm/s"), std::string::npos);
}

}  // namespace
}  // namespace osteomill::target_limit_test
