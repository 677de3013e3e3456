#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "analysis/report/motion_metrics.h"

namespace osteomill {
namespace {

constexpr double rate_hz = 30.0;

/// From rest to rest with least jerk: 10 s^3 - 15 s^4 + 6 s^5 (Flash and Hogan).
double least_jerk(double share) {
    return share * share * share * (10.0 + share * (-15.0 + 6.0 * share));
}

std::vector<TimedPosition> reach(double duration_s, double length_mm) {
    std::vector<TimedPosition> motion;
    const int samples = static_cast<int>(std::lround(duration_s * rate_hz));
    for (int i = 0; i <= samples; ++i)
        motion.push_back(
            {i / rate_hz, {length_mm * least_jerk(static_cast<double>(i) / samples), 2.0, -3.0}});
    return motion;
}

TEST(Smoothness, OfAReachOfLeastJerkIsWhatTheFormulaGives) {
    // Integral of the squared jerk: 720 A^2 / T^5. Peak speed: 1.875 A / T.
    const double known = -std::log(720.0 / (1.875 * 1.875));
    EXPECT_NEAR(known, -5.322, 1e-3);
    EXPECT_NEAR(*log_dimensionless_jerk(reach(4.0, 50.0)), known, 0.02);
    EXPECT_NEAR(*log_dimensionless_jerk(reach(2.0, 50.0)), known, 0.05);
    EXPECT_NEAR(*log_dimensionless_jerk(reach(4.0, 1.0)), *log_dimensionless_jerk(reach(4.0, 50.0)), 1e-9)
        << "its size does not count";
}

TEST(Smoothness, IsThatOfSoManyReachesInARow) {
    EXPECT_NEAR(reaches_in_a_row(-std::log(204.8)), 1.0, 1e-12);
    std::vector<TimedPosition> three;
    for (int i = 0; i <= 3 * 3 * rate_hz; ++i) {
        const double reaches = i / rate_hz / 3.0;
        three.push_back(
            {i / rate_hz, {20.0 * (std::floor(reaches) + least_jerk(reaches - std::floor(reaches))), 0, 0}});
    }
    const double ldlj = *log_dimensionless_jerk(three);
    EXPECT_NEAR(reaches_in_a_row(ldlj), 3.0, 0.1);
    EXPECT_STREQ(smoothness_word(1.4), "flowing");
    EXPECT_STREQ(smoothness_word(2.9), "smooth");
    EXPECT_STREQ(smoothness_word(5.9), "uneven");
    EXPECT_STREQ(smoothness_word(6.1), "jerky");
}

TEST(Smoothness, OfACircleIsWhatTheFormulaGives) {
    // Jerk r w^3 and speed r w throughout: T^3 / (r w)^2 * (r w^3)^2 T = (w T)^4.
    std::vector<TimedPosition> motion;
    const double turn_s = 4.0;
    for (int i = 0; i <= turn_s * rate_hz; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / rate_hz / turn_s;
        motion.push_back({i / rate_hz, {5.0 * std::cos(angle), 5.0 * std::sin(angle), 1.0}});
    }
    EXPECT_NEAR(*log_dimensionless_jerk(motion), -4.0 * std::log(2.0 * std::numbers::pi), 0.01);
}

TEST(Smoothness, DoesNotDependOnEvenSampling) {
    std::vector<TimedPosition> motion;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> early_s(0.0, 0.01);
    for (int i = 0; i <= 120; ++i) {
        const double time_s = i == 0 || i == 120 ? i / rate_hz : i / rate_hz - early_s(random);
        motion.push_back({time_s, {50.0 * least_jerk(time_s / 4.0), 0.0, 0.0}});
    }
    EXPECT_NEAR(*log_dimensionless_jerk(motion), -5.322, 0.03);
}

TEST(Smoothness, HasNoneWhereNothingChangesTheAcceleration) {
    std::vector<TimedPosition> motion;
    for (int i = 0; i < 60; ++i) motion.push_back({i / rate_hz, {0.5 * i, 0.25 * i, 100.0}});
    EXPECT_FALSE(log_dimensionless_jerk(motion));
    for (TimedPosition& sample : motion) sample.position_mm = glm::dvec3(7.0);
    EXPECT_FALSE(log_dimensionless_jerk(motion)) << "at rest";
    for (TimedPosition& sample : motion) sample.time_s = 1.0;
    EXPECT_FALSE(log_dimensionless_jerk(motion)) << "all at one time";
    EXPECT_FALSE(log_dimensionless_jerk({}));
}

}  // namespace
}  // namespace osteomill
