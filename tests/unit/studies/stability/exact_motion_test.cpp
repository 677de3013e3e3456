#include "studies/stability/exact_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace osteomill::study::exact_motion_test {
namespace {

TEST(ExactMotion, CoastsToRestAsAnExponentialWhenOnlyDamped) {
    const HeldBody body{.mass_kg = 0.045, .damping_n_s_per_m = 0.5};
    const double h = 0.03;
    const double left = std::exp(-0.5 * h / 0.045);
    const MotionState end = exact_motion(body, h).after({0.001, 0.2}, 0.0);
    EXPECT_NEAR(end.velocity_m_per_s, 0.2 * left, 1e-15);
    EXPECT_NEAR(end.position_m, 0.001 + 0.2 * 0.045 / 0.5 * (1.0 - left), 1e-15);
}

TEST(ExactMotion, SwingsAboutWhereTheForceAndTheSpringBalance) {
    const HeldBody body{.mass_kg = 0.145, .damping_n_s_per_m = 2.1, .hand_stiffness_n_per_m = 100.0};
    const double h = 0.05;
    const double decay = 2.1 / (2.0 * 0.145);
    const double turn = std::sqrt(100.0 / 0.145 - decay * decay);
    const double balance = 0.4 / 100.0;
    // From rest at the origin: x = F/k (1 - e^-dt (cos wt + d/w sin wt)).
    const double expected =
        balance * (1.0 - std::exp(-decay * h) * (std::cos(turn * h) + decay / turn * std::sin(turn * h)));
    EXPECT_NEAR(exact_motion(body, h).after({}, 0.4).position_m, expected, 1e-15);
}

TEST(ExactMotion, RefusesABodyThatIsNotLinear) {
    EXPECT_THROW(exact_motion({.coulomb_friction_n = 0.26}, 1e-3), std::invalid_argument);
    EXPECT_THROW(exact_motion({.mass_kg = 0.0}, 1e-3), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::study::exact_motion_test
