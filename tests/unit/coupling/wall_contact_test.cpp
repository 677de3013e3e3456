// Couplings against the walls that are known to be the stiffest that hold.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>

#include "simulation/coupling/couplings.h"
#include "tests/support/bench/bench_run.h"

namespace osteomill::wall_contact_test {
namespace {

using testing::arm_in_hand;
using testing::bare_arm;
using testing::Bench;

/// A coupling pressed on a wall, spindle off, as the force law of the stability bench.
struct Wall {
    double stiffness_n_per_m = 1500.0;
    /// The wall's position. If it is far to the left, the arm never leaves it, and the system is linear.
    double at_m = 0.0;
    double push_n = 0.0;          ///< steady, on the device
    bool starts_at_rest = false;  ///< as if pressed for long at the origin, by the force that this takes
    int ticks_per_step = 1;
    double resolution_m = 0.0;  ///< as the coupling is told
};

class WallOnBench {
  public:
    WallOnBench(const std::string& coupling, const Wall& wall)
        : wall_(wall),
          coupling_(make_coupling(coupling_named(coupling),
                                  {.device = {.max_stiffness_n_per_mm = 1e-3 * wall.stiffness_n_per_m,
                                              .position_resolution_mm = 1e3 * wall.resolution_m},
                                   .milling_period_s = tick_s * wall.ticks_per_step})) {
        result_->engagement.count = 1;
        result_->engagement.patches[0] = {
            .normal = {1.0, 0.0, 0.0}, .gap_mm = 1e3 * wall.at_m, .area_mm2 = 1e4};
        if (!wall.starts_at_rest) return;
        double force_n = 0.0;
        for (int tick = 0; tick < 200 * wall.ticks_per_step; ++tick) force_n = (*this)(0.0);
        wall_.push_n -= force_n;
    }

    double operator()(double position_m) {
        if (tick_ % wall_.ticks_per_step == 0) ++result_->step;
        const double velocity_m_per_s = tick_ == 0 ? 0.0 : (position_m - last_position_m_) / tick_s;
        last_position_m_ = position_m;
        const HandState hand{.now_s = tick_s * tick_++,
                             .pose = {{1e3 * position_m, 0.0, 0.0}, {0.0, 0.0, 1.0}},
                             .velocity_mm_per_s = {1e3 * velocity_m_per_s, 0.0, 0.0}};
        return wall_.push_n + coupling_->tick(hand, *result_).force_n.x;
    }

    static constexpr double tick_s = 0.001;

  private:
    Wall wall_;
    std::unique_ptr<Coupling> coupling_;
    std::unique_ptr<MillingResult> result_ = std::make_unique<MillingResult>();
    int tick_ = 0;
    double last_position_m_ = 0.0;
};

/// In the wall by a metre: pressed and pulled alike.
Wall two_sided_wall(double stiffness_n_per_m, int ticks_per_step = 1) {
    return {.stiffness_n_per_m = stiffness_n_per_m,
            .at_m = -1.0,
            .starts_at_rest = true,
            .ticks_per_step = ticks_per_step};
}

/// Whether a push dies away.
bool dies_away(const Bench& bench, const std::string& coupling, const Wall& wall, std::size_t ticks) {
    const auto law = std::make_shared<WallOnBench>(coupling, wall);
    const auto run = run_bench(
        bench, [law](double position_m) { return (*law)(position_m); }, testing::push, ticks, 0.5);
    return testing::growth_per_s(run, bench.tick_s, ticks) < 0.0;
}

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
