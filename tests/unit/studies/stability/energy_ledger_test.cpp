#include "studies/stability/energy_ledger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "studies/stability/bench_run.h"
#include "studies/stability/lifted_system.h"
#include "studies/stability/sampled_force.h"

namespace osteomill::study::energy_ledger_test {
namespace {

constexpr double tick_s = 1e-3;

/// A mass on an ideal spring that is held from tick to tick, nothing else.
struct IdealSpring {
    double stiffness_n_per_m = 200.0;
    HeldBody body = bare_arm(0.0);
    double turn_per_s = std::sqrt(stiffness_n_per_m / body.mass_kg);

    std::vector<BenchTick> run(std::size_t ticks) const {
        return run_bench({.body = body}, SampledForce(wall(stiffness_n_per_m), zero_order_hold(), tick_s),
                         push, ticks);
    }
};

TEST(EnergyLedger, AccountsForAllTheKineticEnergyThatAHeldSpringGives) {
    const IdealSpring spring;
    const std::vector<BenchTick> run = spring.run(500);
    const double start_j = 0.5 * spring.body.mass_kg * push.velocity_m_per_s * push.velocity_m_per_s;
    for (std::size_t i = 1; i < run.size(); ++i) {
        const double v = run[i].state.velocity_m_per_s;
        const double gained_j = 0.5 * spring.body.mass_kg * v * v - start_j;
        EXPECT_NEAR(-run[i - 1].taken_j, gained_j, 1e-9 * start_j);
    }
}

TEST(EnergyLedger, SeesASwingGainPiTimesItsAnglePerTick) {
    // A hold is half a period late, a damper of -K T / 2: the energy grows by a factor of e^(pi w T) a swing.
    const IdealSpring spring;
    const double swing_s = 2.0 * std::numbers::pi / spring.turn_per_s;
    const double expected_per_s = std::numbers::pi * spring.turn_per_s * tick_s / swing_s;
    const double by_eigenvalues =
        2.0 / tick_s *
        std::log(spectral_radius(
            lifted_system(spring.body, wall(spring.stiffness_n_per_m), zero_order_hold(), tick_s)));
    EXPECT_NEAR(by_eigenvalues, expected_per_s, 0.03 * expected_per_s);
    const std::size_t ticks = 3000;
    EXPECT_NEAR(2.0 * growth_per_s(spring.run(ticks), tick_s, ticks), expected_per_s, 0.03 * expected_per_s);
}

TEST(EnergyLedger, SeesWhatAnObserverWithBackwardVelocityDoesNot) {
    const std::vector<BenchTick> run = IdealSpring{}.run(2000);
    EnergyLedger held;
    EnergyLedger backward;
    for (std::size_t i = 1; i + 1 < run.size(); ++i) {
        const double here_m = run[i].state.position_m;
        held.held(run[i].force_n, run[i + 1].state.position_m - here_m);
        backward.held(run[i].force_n, here_m - run[i - 1].state.position_m);
    }
    EXPECT_LT(held.taken_j(), 0.0);
    EXPECT_GT(backward.taken_j(), 0.0) << "it takes the leak for a loss";
}

}  // namespace
}  // namespace osteomill::study::energy_ledger_test
