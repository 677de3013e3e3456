#include "tests/support/bench/fine_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteomill::testing::fine_motion_test {
namespace {

MotionState after(const HeldBody& body, MotionState state, double force_n, double substep_s, int substeps) {
    for (int i = 0; i < substeps; ++i) state = fine_step(body, state, force_n, substep_s);
    return state;
}

TEST(FineMotion, SwingsAboutWhereTheForceAndTheSpringBalance) {
    // From rest at the origin: x = F/k (1 - e^-dt (cos wt + d/w sin wt)).
    const HeldBody body{.mass_kg = 0.145, .damping_n_s_per_m = 2.1, .hand_stiffness_n_per_m = 100.0};
    const double decay = 2.1 / (2.0 * 0.145);
    const double turn = std::sqrt(100.0 / 0.145 - decay * decay);
    const double exact_m =
        0.4 / 100.0 *
        (1.0 - std::exp(-decay * 0.1) * (std::cos(turn * 0.1) + decay / turn * std::sin(turn * 0.1)));
    const double coarse_m = after(body, {}, 0.4, 1e-3, 100).position_m - exact_m;
    const double fine_m = after(body, {}, 0.4, 5e-4, 200).position_m - exact_m;
    EXPECT_NEAR(after(body, {}, 0.4, 1e-5, 10'000).position_m, exact_m, 1e-7 * exact_m);
    EXPECT_NEAR(coarse_m / fine_m, 4.0, 0.05) << "of second order";
}

TEST(FineMotion, NeitherGainsNorLosesTheEnergyOfASpring) {
    const HeldBody body{.mass_kg = 0.045, .damping_n_s_per_m = 0.0, .hand_stiffness_n_per_m = 1500.0};
    const MotionState end = after(body, {0.001, 0.0}, 0.0, 1e-5, 100'000);
    const double energy_j = 0.5 * 0.045 * end.velocity_m_per_s * end.velocity_m_per_s +
                            0.5 * 1500.0 * end.position_m * end.position_m;
    EXPECT_NEAR(energy_j, 0.5 * 1500.0 * 1e-6, 1e-9 * energy_j);
}

TEST(CoulombFriction, StopsASlideWhereItsWorkHasTakenTheKineticEnergy) {
    const HeldBody body{.mass_kg = 0.045, .damping_n_s_per_m = 0.0, .coulomb_friction_n = 0.26};
    for (const double velocity : {0.1, -0.1})
        for (const double substep_s : {1e-5, 7e-3}) {
            const MotionState end = after(body, {0.0, velocity}, 0.0, substep_s, 10'000);
            EXPECT_EQ(end.velocity_m_per_s, 0.0);
            EXPECT_NEAR(end.position_m, std::copysign(0.5 * 0.045 * 0.01 / 0.26, velocity), 1e-12);
        }
}

TEST(CoulombFriction, HoldsABodyAgainstASmallerForceAndYieldsToALarger) {
    const HeldBody body{.mass_kg = 0.045, .damping_n_s_per_m = 0.0, .coulomb_friction_n = 0.26};
    EXPECT_EQ(after(body, {}, 0.25, 1e-5, 1000).position_m, 0.0);
    EXPECT_EQ(after(body, {}, -0.25, 1e-5, 1000).position_m, 0.0);
    // 10 ms under what the friction leaves: x = (F - F_f) t^2 / 2 m.
    EXPECT_NEAR(after(body, {}, -1.26, 1e-5, 1000).position_m, -1e-4 / (2.0 * 0.045), 1e-12);
}

TEST(CoulombFriction, TakesTheSameLengthFromEveryHalfSwing) {
    const HeldBody body{.mass_kg = 0.045,
                        .damping_n_s_per_m = 0.0,
                        .hand_stiffness_n_per_m = 300.0,
                        .coulomb_friction_n = 0.26};
    MotionState state{0.01, 0.0};
    // Turning points come nearer by 2 F_f / k = 1.73 mm each, until one lies within F_f / k = 0.87 mm:
    // 10, -8.27, 6.53, -4.8, 3.07, -1.33, -0.4 mm.
    state = after(body, state, 0.0, 1e-5, 100'000);
    EXPECT_EQ(state.velocity_m_per_s, 0.0);
    EXPECT_NEAR(state.position_m, -0.0004, 1e-8);
}

}  // namespace
}  // namespace osteomill::testing::fine_motion_test
