// Couplings against the walls that are known to be the stiffest that hold.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "tests/unit/coupling/wall_on_bench.h"

namespace osteomill::wall_contact_test {
namespace {

using testing::arm_in_hand;
using testing::bare_arm;
using testing::Bench;
using testing::dies_away;
using testing::two_sided_wall;
using testing::Wall;
using testing::WallOnBench;

constexpr double tick_s = WallOnBench::tick_s;
constexpr double encoder_step_m = 55e-6;

struct Direct {
    std::string coupling;
    int ticks_per_step;
    /// Stiffness of the largest wall for which all eigenvalues of the linear form, from model step to model
    /// step, lie inside the unit circle: bare arm, 0.5 N s/m.
    double edge_n_per_m;
};

void PrintTo(const Direct& direct, std::ostream* out) {
    *out << direct.coupling << ", a force every " << direct.ticks_per_step << " ticks";
}

class DirectWall : public ::testing::TestWithParam<Direct> {};

TEST_P(DirectWall, HoldsUpToTheEdgeOfItsLinearForm) {
    const auto& [coupling, ticks_per_step, edge] = GetParam();
    const Bench bench{.body = bare_arm(0.5), .substeps = 20};
    EXPECT_TRUE(dies_away(bench, coupling, two_sided_wall(0.93 * edge, ticks_per_step), 3000)) << edge;
    EXPECT_FALSE(dies_away(bench, coupling, two_sided_wall(1.07 * edge, ticks_per_step), 3000)) << edge;
}

INSTANTIATE_TEST_SUITE_P(Couplings, DirectWall,
                         ::testing::Values(Direct{"hold", 1, 1001.8}, Direct{"hold", 10, 101.88},
                                           Direct{"interpolate", 10, 54.036},
                                           Direct{"sample-estimate-hold", 1, 9352.4},
                                           Direct{"sample-estimate-hold", 10, 294.34},
                                           Direct{"corrected-sample-estimate-hold", 10, 642.74},
                                           Direct{"sample-estimate-interpolate", 10, 95.481}));

TEST(DamperOnAWall, HoldsOneThatAHoldDoesNot) {
    const Bench bench{.body = bare_arm(0.5), .substeps = 20};  // edge of hold: 1002 N/m
    EXPECT_FALSE(dies_away(bench, "hold", two_sided_wall(1500.0), 1500));
    EXPECT_TRUE(dies_away(bench, "hold+damper", two_sided_wall(1500.0), 1500));
}

/// The largest |x - mean| in the last fifth of a second of two, pressed on the wall with a newton.
double unrest_m(const std::string& coupling, const Bench& bench, const Wall& wall) {
    const auto law = std::make_shared<WallOnBench>(coupling, wall);
    const auto run = testing::run_bench(
        bench, [law](double position_m) { return (*law)(position_m); },
        {.position_m = -1e-3, .velocity_m_per_s = 0.02}, 2000, 0.5);
    double lowest = run.back().state.position_m;
    double highest = lowest;
    for (std::size_t tick = run.size() - 200; tick < run.size(); ++tick) {
        lowest = std::min(lowest, run[tick].state.position_m);
        highest = std::max(highest, run[tick].state.position_m);
    }
    return 0.5 * (highest - lowest);
}

TEST(PassivityOnAWall, KeepsAHoldFromSwingingUp) {
    const Bench bench{.body = bare_arm(0.5), .substeps = 20, .max_force_n = 3.3};
    const Wall wall{.stiffness_n_per_m = 1500.0, .push_n = 1.0};
    EXPECT_GT(unrest_m("hold", bench, wall), 1e-3);
    EXPECT_LT(unrest_m("passivity", bench, wall), 0.2e-3);
}

TEST(SpringsOnAWall, HoldAtTheDevicesStiffnessOneTickLate) {
    for (const char* coupling : {"implicit", "virtual-coupling"})
        for (const std::size_t delay : {0, 1})
            for (const testing::HeldBody& body :
                 {bare_arm(0.5), arm_in_hand(Grip::light), arm_in_hand(Grip::firm)})
                EXPECT_TRUE(dies_away({.body = body, .substeps = 20, .delay_ticks = delay}, coupling,
                                      two_sided_wall(1500.0), 1500))
                    << coupling << " late by " << delay << " on " << body.mass_kg;
}

TEST(SpringsOnAWall, ImplicitHoldsUpToTheEdgeThatItsHeaderStates) {
    const double edges_n_per_m[] = {6200.0, 2270.0, 1350.0};  // coupling_spring.h, bare arm
    for (const std::size_t delay : {0, 1, 2}) {
        const Bench bench{.body = bare_arm(0.5), .substeps = 20, .delay_ticks = delay};
        EXPECT_TRUE(dies_away(bench, "implicit", two_sided_wall(0.93 * edges_n_per_m[delay]), 1500)) << delay;
        EXPECT_FALSE(dies_away(bench, "implicit", two_sided_wall(1.07 * edges_n_per_m[delay]), 1500))
            << delay;
    }
}

TEST(SpringsOnAWall, ImplicitRestsOnOneThatIsReadInStepsAndFeltThroughFriction) {
    const Wall wall{.push_n = 1.0, .resolution_m = encoder_step_m};
    for (const std::size_t delay : {0, 1}) {
        testing::HeldBody body = bare_arm(0.5);
        const auto bench = [&] {
            return Bench{.body = body,
                         .substeps = 50,
                         .sensor_resolution_m = encoder_step_m,
                         .max_force_n = 3.3,
                         .delay_ticks = delay};
        };
        EXPECT_LT(unrest_m("implicit", bench(), wall), (delay == 0 ? 2.0 : 5.0) * encoder_step_m)
            << "hunts about the steps";
        body.coulomb_friction_n = 0.26;
        EXPECT_LT(unrest_m("implicit", bench(), wall), 1e-9) << "rests";
    }
}

}  // namespace
}  // namespace osteomill::wall_contact_test
