// The bench against known edges of stability, twice over: by the eigenvalues of the lifted system, and by
// whether a swing grows in a run in fine substeps. Both within 3 % of the known value.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "studies/stability/bench_run.h"
#include "studies/stability/largest_stable.h"
#include "studies/stability/lifted_system.h"
#include "studies/stability/sampled_force.h"

namespace osteomill::study::known_edges_test {
namespace {

constexpr double tick_s = 1e-3;
constexpr double tolerance = 0.03;

bool swing_grows(const HeldBody& body, const ModelForce& model, const LinearHold& hold) {
    constexpr std::size_t ticks = 3000;  // 3 s: the slowest here grows by 3 % from third to third
    return growth_per_s(run_bench({.body = body}, SampledForce(model, hold, tick_s), push, ticks), tick_s,
                        ticks) > 0.0;
}

double largest_stiffness_n_per_m(const HeldBody& body, const LinearHold& hold) {
    return largest_stable([&](double gain) { return is_stable(body, wall(gain), hold, tick_s); });
}

void expect_edge(const HeldBody& body, const LinearHold& hold, double known_n_per_m) {
    EXPECT_NEAR(largest_stiffness_n_per_m(body, hold), known_n_per_m, tolerance * known_n_per_m);
    EXPECT_FALSE(swing_grows(body, wall(known_n_per_m * (1.0 - tolerance)), hold)) << known_n_per_m;
    EXPECT_TRUE(swing_grows(body, wall(known_n_per_m * (1.0 + tolerance)), hold)) << known_n_per_m;
}

struct KnownEdge {
    std::string method;
    LinearHold hold;
    HeldBody body;
    double largest_stiffness_n_per_m;
};

void PrintTo(const KnownEdge& edge, std::ostream* out) {
    *out << edge.method << ", " << edge.largest_stiffness_n_per_m << " N/m";
}

class KnownEdges : public ::testing::TestWithParam<KnownEdge> {};

TEST_P(KnownEdges, AreReproducedByEigenvaluesAndByRuns) {
    expect_edge(GetParam().body, GetParam().hold, GetParam().largest_stiffness_n_per_m);
}

// Exact eigenvalues, computed independently and in part known in closed form (below).
std::vector<KnownEdge> table() {
    const HeldBody light = arm_in_hand(Grip::light);
    const HeldBody firm = arm_in_hand(Grip::firm);
    const LinearHold hold = zero_order_hold();
    const LinearHold late = one_sample_late();
    const LinearHold estimate = sample_estimate_hold();
    const LinearHold straight = interpolated(10);
    const LinearHold slow_estimate = sample_estimate_hold(10);
    return {{"hold", hold, bare_arm(0.1), 200.0},
            {"hold", hold, bare_arm(0.5), 1002.0},
            {"hold", hold, bare_arm(1.0), 2007.0},
            {"hold", hold, light, 4210.0},
            {"hold", hold, firm, 10216.0},
            {"late", late, bare_arm(0.1), 67.0},
            {"late", late, bare_arm(0.5), 334.0},
            {"late", late, bare_arm(1.0), 671.0},
            {"late", late, light, 1406.0},
            {"late", late, firm, 3410.0},
            {"estimate", estimate, bare_arm(0.1), 4212.0},
            {"estimate", estimate, bare_arm(0.5), 9353.0},
            {"estimate", estimate, bare_arm(1.0), 13177.0},
            {"estimate", estimate, light, 34312.0},
            {"interpolated100Hz", straight, bare_arm(0.1), 10.6},
            {"interpolated100Hz", straight, bare_arm(0.5), 54.0},
            {"interpolated100Hz", straight, bare_arm(1.0), 111.0},
            {"interpolated100Hz", straight, light, 232.0},
            {"interpolated100Hz", straight, firm, 556.0},
            {"estimate100Hz", slow_estimate, bare_arm(0.1), 132.0},
            {"estimate100Hz", slow_estimate, bare_arm(0.5), 294.0},
            {"estimate100Hz", slow_estimate, bare_arm(1.0), 423.0},
            {"estimate100Hz", slow_estimate, light, 1048.0},
            {"estimate100Hz", slow_estimate, firm, 3144.0}};
}

INSTANTIATE_TEST_SUITE_P(Table, KnownEdges, ::testing::ValuesIn(table()),
                         [](const ::testing::TestParamInfo<KnownEdge>& edge) {
                             return edge.param.method + "_" +
                                    std::to_string(std::lround(1000.0 * edge.param.body.mass_kg)) + "g_" +
                                    std::to_string(std::lround(1000.0 * edge.param.body.damping_n_s_per_m)) +
                                    "mNsPerM";
                         });

TEST(EdgeRules, HoldIsStableUpToTwiceTheDampingOverThePeriod) {
    for (const double b : {0.05, 0.2, 0.8}) expect_edge(bare_arm(b), zero_order_hold(), 2.0 * b / tick_s);
}

TEST(EdgeRules, ASampleLateCostsTwoThirdsOfIt) {
    for (const double b : {0.05, 0.2, 0.8})
        expect_edge(bare_arm(b), one_sample_late(), 2.0 * b / (3.0 * tick_s));
}

TEST(EdgeRules, EveryTickOfDelayAddsAPeriodToTheHalfOfTheHold) {
    for (const std::size_t ticks : {1, 2, 3}) {
        const double delay_s = (0.5 + static_cast<double>(ticks)) * tick_s;
        expect_edge(bare_arm(0.2), late_by_ticks(zero_order_hold(), ticks), 0.2 / delay_s);
    }
}

TEST(EdgeRules, SampleEstimateHoldGrowsWithTheRootOfMassAndDamping) {
    for (const double b : {0.05, 0.2, 0.8})
        expect_edge(bare_arm(b), sample_estimate_hold(),
                    2.0 * std::sqrt(0.045 * b / (tick_s * tick_s * tick_s)));
}

TEST(EdgeRules, InterpolationFrom100HzActsNineAndAHalfMillisecondsLate) {
    for (const double b : {0.05, 0.1, 0.3}) expect_edge(bare_arm(b), interpolated(10), b / 9.5e-3);
}

TEST(EdgeRules, AnEstimateAfterInterpolationGainsOnlyFivePercent) {
    for (const double b : {0.05, 0.1, 0.3})
        expect_edge(bare_arm(b), then_estimated(interpolated(10)), b / 9.0e-3);
    const double gain = largest_stiffness_n_per_m(bare_arm(0.1), then_estimated(interpolated(10))) /
                        largest_stiffness_n_per_m(bare_arm(0.1), interpolated(10));
    EXPECT_NEAR(gain, 1.05, 0.01);
}

TEST(EdgeRules, ASampledDamperIsStableUpToTwiceTheMassOverThePeriod) {
    // A spring of next to nothing keeps the body at a place, so that all eigenvalues can be inside.
    const HeldBody body{.mass_kg = 0.045, .damping_n_s_per_m = 0.0, .hand_stiffness_n_per_m = 1.0};
    for (const std::size_t ticks_per_sample : {1, 10}) {
        const LinearHold hold = zero_order_hold(ticks_per_sample);
        const double known = 2.0 * 0.045 / (static_cast<double>(ticks_per_sample) * tick_s);
        const double edge =
            largest_stable([&](double gain) { return is_stable(body, damper(gain), hold, tick_s); });
        EXPECT_NEAR(edge, known, tolerance * known);
        EXPECT_FALSE(swing_grows(body, damper(known * (1.0 - tolerance)), hold)) << known;
        EXPECT_TRUE(swing_grows(body, damper(known * (1.0 + tolerance)), hold)) << known;
    }
}

}  // namespace
}  // namespace osteomill::study::known_edges_test
