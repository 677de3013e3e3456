// A coupling pressed on a wall, spindle off, as the force law of the stability bench.
#pragma once

#include <memory>
#include <string>

#include "simulation/coupling/couplings.h"
#include "tests/support/bench/bench_run.h"

namespace osteomill::testing {

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
inline Wall two_sided_wall(double stiffness_n_per_m, int ticks_per_step = 1) {
    return {.stiffness_n_per_m = stiffness_n_per_m,
            .at_m = -1.0,
            .starts_at_rest = true,
            .ticks_per_step = ticks_per_step};
}

/// Whether a push dies away.
inline bool dies_away(const Bench& bench, const std::string& coupling, const Wall& wall, std::size_t ticks) {
    const auto law = std::make_shared<WallOnBench>(coupling, wall);
    const auto run = run_bench(
        bench, [law](double position_m) { return (*law)(position_m); }, push, ticks, 0.5);
    return growth_per_s(run, bench.tick_s, ticks) < 0.0;
}

}  // namespace osteomill::testing
