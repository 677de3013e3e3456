#include "studies/stability/map/stability_verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/support/bench/bench_run.h"

namespace osteomill::study::stability_verdict_test {
namespace {

using testing::bare_arm;
using testing::Bench;
using testing::BenchTick;

using Signal = std::function<double(double time_s)>;

std::vector<glm::dvec3> sampled(const Signal& signal, std::size_t ticks) {
    std::vector<glm::dvec3> samples;
    for (std::size_t i = 0; i < ticks; ++i)
        samples.emplace_back(signal(1e-3 * static_cast<double>(i)), 0.0, 0.0);
    return samples;
}

double sine(double hz, double time_s) {
    return std::sin(2.0 * std::numbers::pi * hz * time_s);
}

TEST(FastPart, LeavesOutParabolasAndTheHandsSwingAndKeepsChatter) {
    EXPECT_LT(rms(fast_part(sampled([](double t) { return 1.0 + 2.0 * t - 30.0 * t * t; }, 400))), 1e-12);
    EXPECT_LT(rms(fast_part(sampled([](double t) { return sine(4.2, t); }, 800))), 0.01);
    EXPECT_NEAR(rms(fast_part(sampled([](double t) { return sine(50.0, t); }, 800))), std::sqrt(0.5), 0.1);
}

constexpr std::size_t ticks = 730;
constexpr double push_n = -1.0;

/// The verdict on a force about a truth of -1 N and the hand's swing, of a tool fed on at 6 mm/s.
Verdict verdict_on_force(const Signal& beside, double taken_mj_per_s = 6.0) {
    const Signal truth = [](double t) { return push_n + 0.2 * sine(4.2, t); };
    const auto truth_n = sampled(truth, ticks);
    const auto force_n = sampled([&](double t) { return truth(t) + beside(t); }, ticks);
    std::vector<double> taken_mj;
    for (std::size_t i = 0; i < ticks; ++i)
        taken_mj.push_back(taken_mj_per_s * 1e-3 * static_cast<double>(i + 1));
    return verdict_on({.force_n = force_n,
                       .taken_mj = taken_mj,
                       .truth_force_n = truth_n,
                       .truth_taken_mj = {},
                       .window_begins = 300,
                       .window_ends = 700});
}

TEST(Verdict, LetsTheTruthsOwnSwingAndASlowerSwayPass) {
    EXPECT_TRUE(verdict_on_force([](double) { return 0.0; }).is_stable);
    EXPECT_TRUE(verdict_on_force([](double t) { return 0.3 * sine(2.0, t); }).is_stable);
}

TEST(Verdict, IsUnstableForALimitCycleThatFingersFeel) {
    EXPECT_TRUE(verdict_on_force([](double t) { return 0.04 * sine(60.0, t); }).is_stable);
    const Verdict verdict = verdict_on_force([](double t) { return 0.2 * sine(60.0, t); });
    EXPECT_FALSE(verdict.is_stable);
    EXPECT_NEAR(verdict.limit_cycle_n, 0.2 * std::sqrt(0.5), 0.015);
}

TEST(Verdict, IsUnstableForARingThatGrowsAndStableForOneThatDies) {
    EXPECT_FALSE(
        verdict_on_force([](double t) { return 0.005 * std::exp(3.0 * t) * sine(60.0, t); }).is_stable);
    EXPECT_TRUE(verdict_on_force([](double t) { return std::exp(-2.0 * t) * sine(60.0, t); }).is_stable);
}

TEST(Verdict, IsUnstableForAForceThatGivesEnergy) {
    const Verdict verdict = verdict_on_force([](double) { return 0.0; }, -1.0);
    EXPECT_FALSE(verdict.is_stable);
    EXPECT_NEAR(verdict.injected_mj, 0.73, 0.01);
}

/// The verdict on a run of the bench of one dimension against a steady truth, judged in its last three
/// quarters.
Verdict verdict_on_bench(const std::vector<BenchTick>& run, double truth_n, double spring_n_per_mm) {
    std::vector<glm::dvec3> force_n;
    std::vector<double> taken_mj;
    for (const BenchTick& tick : run) {
        force_n.emplace_back(tick.force_n, 0.0, 0.0);
        taken_mj.push_back(1e3 * tick.taken_j);
    }
    const std::vector<glm::dvec3> truth(run.size(), glm::dvec3(truth_n, 0.0, 0.0));
    return verdict_on({.force_n = force_n,
                       .taken_mj = taken_mj,
                       .truth_force_n = truth,
                       .truth_taken_mj = {},
                       .window_begins = run.size() / 4,
                       .window_ends = run.size() - fit_reach_ticks,
                       .spring_n_per_mm = spring_n_per_mm});
}

TEST(Verdict, FindsTheEdgeOfAHeldWall) {
    // K = 2 b / T, a tenth below and above it.
    for (const double share : {0.9, 1.1}) {
        const double k = share * 1000.0;
        const Bench bench{.body = bare_arm(0.5), .substeps = 50};
        const auto run = run_bench(
            bench, [k](double position_m) { return -k * position_m; }, testing::push, 12'000, 0.01);
        EXPECT_EQ(verdict_on_bench(run, 0.0, 1e-3 * k).is_stable, share < 1.0) << share;
    }
}

/// Bone that a burr has cut up to a front, its force held for some ticks: it resists in proportion to how
/// fast the front advances, and gives nothing to a burr that draws back.
class HeldFront {
  public:
    HeldFront(double cutting_n_s_per_m, int held_ticks)
        : cutting_n_s_per_m_(cutting_n_s_per_m), held_ticks_(held_ticks) {}

    double operator()(double position_m) {
        if (tick_++ % held_ticks_ != 0) return force_n_;
        const double advance_m = std::max(0.0, position_m - front_m_);
        front_m_ += advance_m;
        return force_n_ = -cutting_n_s_per_m_ * advance_m / (1e-3 * held_ticks_);
    }

  private:
    double cutting_n_s_per_m_;
    int held_ticks_;
    int tick_ = 0;
    double front_m_ = 0.0;
    double force_n_ = 0.0;
};

TEST(Verdict, FindsTheChatterOfHeldCuttingForces) {
    // B in N s/m, ticks for which the force is held, whether it cuts steadily at 6 mm/s.
    struct Row {
        double cutting_n_s_per_m;
        int held_ticks;
        bool is_steady;
    };
    for (const Row& row : {Row{20.0, 10, false}, Row{60.0, 10, false}, Row{20.0, 1, true}, Row{60.0, 1, true},
                           Row{110.0, 1, false}, Row{680.0, 1, false}}) {
        const Bench bench{
            .body = {.mass_kg = 0.045, .damping_n_s_per_m = 2.0, .hand_stiffness_n_per_m = 300.0},
            .substeps = 20,
            .max_force_n = 3.3};
        HeldFront force(row.cutting_n_s_per_m, row.held_ticks);
        double meant_m = 0.0;
        const auto law = [&](double from_meant_m) {
            const double force_n = force(meant_m + from_meant_m);
            meant_m += 6e-6;
            return force_n;
        };
        const auto run = run_bench(bench, law, {}, 4000);
        EXPECT_EQ(verdict_on_bench(run, -6e-3 * row.cutting_n_s_per_m, 0.0).is_stable, row.is_steady)
            << row.cutting_n_s_per_m << " held for " << row.held_ticks;
    }
}

}  // namespace
}  // namespace osteomill::study::stability_verdict_test
