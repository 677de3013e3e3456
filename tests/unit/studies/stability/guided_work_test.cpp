#include "studies/stability/guided_work.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "studies/stability/needed_damping.h"

namespace osteomill::study::guided_work_test {
namespace {

constexpr double tick_s = 1e-3;

struct Case {
    ModelForce model;
    LinearHold hold;
};

const std::vector<Case> cases{{wall(1000.0), zero_order_hold()},
                              {{.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 0.8}, zero_order_hold()},
                              {{.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = -0.3}, zero_order_hold()},
                              {damper(2.0), zero_order_hold()},
                              {wall(1000.0), one_sample_late()},
                              {wall(1000.0), sample_estimate_hold()}};

double needed(const Case& c) {
    return worst_frequency(c.model, c.hold, tick_s).needed_damping_n_s_per_m;
}

/// A hand that wanders: white noise through a low-pass of a random corner, of some millimetres.
std::vector<double> wandering(std::mt19937& random) {
    std::normal_distribution<double> kick(0.0, 1e-3);
    const double keep = std::uniform_real_distribution<double>(-0.99, 0.999)(random);
    std::vector<double> positions_m(300);
    double position_m = 0.0;
    for (double& p : positions_m) p = position_m = keep * position_m + kick(random);
    return positions_m;
}

TEST(GuidedWork, IsNeverNegativeAboveTheNeededDamping) {
    std::mt19937 random(7);
    for (const Case& c : cases)
        for (int hand = 0; hand < 50; ++hand) {
            const GuidedWork work = guided_work(wandering(random), 1.03 * needed(c), c.model, c.hold, tick_s);
            EXPECT_GT(work.by_hand_j(), 0.0);
        }
}

TEST(GuidedWork, IsGivenToAHandThatSwingsAtTheWorstFrequencyBelowIt) {
    for (const Case& c : cases) {
        const WorstFrequency worst = worst_frequency(c.model, c.hold, tick_s);
        std::vector<double> positions_m(20'000);  // ten swings of the slowest: start and end hardly count
        for (std::size_t i = 0; i < positions_m.size(); ++i)
            positions_m[i] = 1e-3 * (1.0 - std::cos(worst.angle * static_cast<double>(i + 1)));
        EXPECT_LT(guided_work(positions_m, 0.97 * worst.needed_damping_n_s_per_m, c.model, c.hold, tick_s)
                      .by_hand_j(),
                  0.0);
    }
}

TEST(GuidedWork, OfAHeldSpringPressedAndReleasedIsStiffnessTimesDepthTimesStrideLess) {
    const double stride_m = 5e-5;  // 50 mm/s
    const int strides = 40;
    std::vector<double> positions_m;
    for (int i = 1; i <= strides; ++i) positions_m.push_back(stride_m * i);
    for (int i = strides - 1; i >= 0; --i) positions_m.push_back(stride_m * i);
    const GuidedWork work = guided_work(positions_m, 0.0, wall(1500.0), zero_order_hold(), tick_s);
    EXPECT_NEAR(work.taken_by_force_j, -1500.0 * (strides * stride_m) * stride_m, 1e-15);
}

}  // namespace
}  // namespace osteomill::study::guided_work_test
