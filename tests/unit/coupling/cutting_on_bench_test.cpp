// The couplings that are solved with the bone, cutting it at one resistance in one dimension, with nothing
// but the arm's own damping beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "simulation/coupling/couplings.h"
#include "tests/support/bench/bench_run.h"

namespace osteomill::cutting_on_bench_test {
namespace {

constexpr double tick_s = 0.001;

/// Pushes an arm with half a newton into bone that resists like a damper.
class Cut {
  public:
    Cut(const std::string& coupling, double resistance_n_s_per_m)
        : coupling_(make_coupling(coupling_named(coupling), {.device = {.max_stiffness_n_per_mm = 1.5}})) {
        result_->step = 1;
        result_->spindle_on = true;
        result_->engagement.count = 1;
        result_->engagement.patches[0] = {.normal = {1.0, 0.0, 0.0},
                                          .cutting_n_s_per_mm = {-1e-3 * resistance_n_s_per_m, 0.0, 0.0},
                                          .area_mm2 = 1.0};
    }

    double operator()(double position_m) {
        const HandState hand{.now_s = tick_s * tick_++,
                             .pose = {{1e3 * position_m, 0.0, 0.0}, {0.0, 0.0, 1.0}},
                             .spindle_on = true};
        return push_n + coupling_->tick(hand, *result_).force_n.x;
    }

    static constexpr double push_n = 0.5;

  private:
    std::unique_ptr<Coupling> coupling_;
    std::unique_ptr<MillingResult> result_ = std::make_unique<MillingResult>();
    int tick_ = 0;
};

void expect_steady_cut(const std::string& coupling) {
    for (const double resistance_n_s_per_m : {10.0, 40.0, 170.0, 860.0, 3000.0})
        for (const std::size_t delay : {0, 1}) {
            const auto cut = std::make_shared<Cut>(coupling, resistance_n_s_per_m);
            const testing::Bench bench{
                .body = testing::bare_arm(0.5), .substeps = 20, .max_force_n = 3.3, .delay_ticks = delay};
            const auto run = testing::run_bench(
                bench, [cut](double position_m) { return (*cut)(position_m); }, {}, 3000);
            // m dv/dt = push - (B + b) v
            const double feed_m_per_s = Cut::push_n / (resistance_n_s_per_m + 0.5);
            for (std::size_t tick = 2000; tick < run.size(); ++tick)
                ASSERT_NEAR(run[tick].state.velocity_m_per_s, feed_m_per_s, 0.01 * feed_m_per_s)
                    << coupling << ", " << resistance_n_s_per_m << " N s/m, late by " << delay << ", tick "
                    << tick;
        }
}

TEST(ImplicitCouplingOnBench, CutsSteadilyWhateverTheResistance) {
    expect_steady_cut("implicit");
}

TEST(VirtualCouplingOnBench, CutsSteadilyWhateverTheResistance) {
    expect_steady_cut("virtual-coupling");
}

}  // namespace
}  // namespace osteomill::cutting_on_bench_test
