#include "tests/support/bench/bench_run.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "tests/support/bench/fine_motion.h"

namespace osteomill::testing {
namespace {

double sensed(double position_m, double resolution_m) {
    return resolution_m > 0.0 ? resolution_m * std::round(position_m / resolution_m) : position_m;
}

double limited(double force_n, double max_force_n) {
    return max_force_n > 0.0 ? std::clamp(force_n, -max_force_n, max_force_n) : force_n;
}

}  // namespace

std::vector<BenchTick> run_bench(const Bench& bench, ForceLaw law, const MotionState& start,
                                 std::size_t ticks, double give_up_m) {
    std::vector<BenchTick> run;
    run.reserve(ticks);
    std::deque<double> in_delay_n(bench.delay_ticks, 0.0);
    double taken_j = 0.0;
    MotionState state = start;
    const double substep_s = bench.tick_s / bench.substeps;
    while (run.size() < ticks && std::abs(state.position_m) < give_up_m) {
        in_delay_n.push_back(law(sensed(state.position_m, bench.sensor_resolution_m)));
        BenchTick tick{.state = state,
                       .force_n = limited(in_delay_n.front(), bench.max_force_n),
                       .farthest_m = std::abs(state.position_m)};
        in_delay_n.pop_front();
        for (int i = 0; i < bench.substeps; ++i) {
            state = fine_step(bench.body, state, tick.force_n, substep_s);
            tick.farthest_m = std::max(tick.farthest_m, std::abs(state.position_m));
        }
        taken_j -= tick.force_n * (state.position_m - tick.state.position_m);
        tick.taken_j = taken_j;
        run.push_back(tick);
    }
    return run;
}

std::span<const BenchTick>::iterator farthest(std::span<const BenchTick> run) {
    return std::ranges::max_element(run, {}, &BenchTick::farthest_m);
}

double growth_per_s(const std::vector<BenchTick>& run, double tick_s, std::size_t ticks_asked) {
    if (run.size() < ticks_asked) return std::numeric_limits<double>::infinity();
    const std::size_t third = run.size() / 3;
    const std::span<const BenchTick> all(run);
    const auto before = farthest(all.subspan(third, third));
    const auto after = farthest(all.subspan(2 * third, third));
    if (after->farthest_m == 0.0) return -std::numeric_limits<double>::infinity();
    const auto ticks_between = static_cast<double>(&*after - &*before);
    return std::log(after->farthest_m / before->farthest_m) / (ticks_between * tick_s);
}

}  // namespace osteomill::testing
