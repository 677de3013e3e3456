#include "simulation/coupling/coupling_spring.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(CouplingSpring, GoesSlackByWhatIsNotFeltAsAJumpWhereBurrAndHandMeet) {
    CouplingSpring spring({.max_stiffness_n_per_mm = 1.5}, 0.01);
    spring.place(glm::dvec3(0.0));
    // The burr follows, then stays behind, then is with the hand.
    for (int i = 1; i <= 10; ++i) {
        spring.follow_hand({0.1 * i, 0.0, 0.0}, tick_s);
        spring.follow_burr({0.1 * i - 0.01, 0.0, 0.0}, tick_s);
    }
    spring.follow_hand({1.2, 0.0, 0.0}, tick_s);
    double before_n = spring.follow_burr({1.0, 0.0, 0.0}, tick_s).x;
    ASSERT_LT(before_n, -0.4);
    for (double hand_mm = 1.3; before_n != 0.0; hand_mm += 0.1) {
        spring.follow_hand({hand_mm, 0.0, 0.0}, tick_s);
        const glm::dvec3 on_hand_n = spring.follow_burr({hand_mm, 0.0, 0.0}, tick_s);
        ASSERT_NEAR(on_hand_n.x, std::min(0.0, before_n + 0.15), 1e-12);
        ASSERT_EQ(on_hand_n.y, 0.0);
        before_n = on_hand_n.x;
    }
}

}  // namespace
}  // namespace osteomill::coupling_spring_test
