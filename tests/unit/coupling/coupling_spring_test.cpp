#include "simulation/coupling/coupling_spring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill::coupling_spring_test {
namespace {

constexpr double tick_s = 0.001;

TEST(CouplingSpring, PullsOnTheBurrAsItPushesOnTheHand) {
    CouplingSpring spring({.max_stiffness_n_per_mm = 1.5}, 0.01);
    spring.place(glm::dvec3(0.0));
    glm::dvec3 hand(0.0);
    glm::dvec3 burr(0.0);
    for (int i = 0; i < 200; ++i) {
        hand += glm::dvec3(0.03, 0.01 * std::sin(0.3 * i), -0.002);
        const LinearPull pull = spring.follow_hand(hand, tick_s);
        const glm::dvec3 step(0.01, 0.02 * std::cos(0.7 * i), 0.0);
        burr += step;
        const glm::dvec3 on_hand_n = spring.follow_burr(burr, tick_s);
        ASSERT_LT(glm::distance(pull.force_n(step), -on_hand_n), 1e-12) << i;
    }
}

TEST(CouplingSpring, IsSlackAtOnceWhereBurrAndHandMeet) {
    CouplingSpring spring({.max_stiffness_n_per_mm = 1.5}, 0.01);
    spring.place(glm::dvec3(0.0));
    spring.follow_hand({1.0, 0.0, 0.0}, tick_s);
    EXPECT_LT(spring.follow_burr(glm::dvec3(0.0), tick_s).x, -1.5) << "spring and damper";
    spring.follow_hand({1.1, 0.0, 0.0}, tick_s);
    EXPECT_EQ(spring.follow_burr({1.1, 0.0, 0.0}, tick_s), glm::dvec3(0.0));
}

}  // namespace
}  // namespace osteomill::coupling_spring_test
