#include "studies/polishing/force_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace osteomill::study {
namespace {

constexpr double sample_s = 0.001;

/// A record of `duration_s` whose force and depth are functions of time.
template <typename Force, typename Depth>
ForceRecord record_of(double duration_s, Force&& force, Depth&& depth) {
    ForceRecord record;
    for (int i = 0; i * sample_s < duration_s; ++i)
        record.push_back(
            {.time_s = i * sample_s, .force_n = force(i * sample_s), .depth_mm = depth(i * sample_s)});
    return record;
}

double half_a_millimetre_a_second(double t_s) {
    return 0.5 * t_s;
}

/// Of amplitude 1 N.
double sine(double hz, double t_s) {
    return std::sin(2.0 * std::numbers::pi * hz * t_s);
}

TEST(ForceMeasures, TellALimitCycleFromASlowForce) {
    const auto record = record_of(
        4.0, [](double t_s) { return glm::dvec3(0.3 * sine(20.0, t_s), 2.0 + t_s, sine(0.2, t_s)); },
        half_a_millimetre_a_second);
    const auto windows = windows_of(record, 0.1);
    ASSERT_EQ(windows.size(), 40u);
    // 20 Hz has whole periods in the slow part's tenth of a second: none of it is left there.
    EXPECT_NEAR(limit_cycle_n(windows), 0.3 / std::numbers::sqrt2, 0.005);
    EXPECT_NEAR(windows[20].depth_mm, half_a_millimetre_a_second(2.0495), 1e-9) << "its middle";
}

TEST(ForceMeasures, SayWhereChatterBegins) {
    const auto force_from = [](double onset_s, double end_s) {
        return [=](double t_s) {
            const bool chatters = t_s >= onset_s && t_s < end_s;
            return glm::dvec3(1.0, 0.0, chatters ? 0.5 * sine(30.0, t_s) : 0.0);
        };
    };
    const auto onset_of = [&](double onset_s, double end_s) {
        const auto record = record_of(4.0, force_from(onset_s, end_s), half_a_millimetre_a_second);
        return onset_of_chatter_mm(windows_of(record, 0.1));
    };
    ASSERT_TRUE(onset_of(2.0, 4.0).has_value());
    EXPECT_NEAR(*onset_of(2.0, 4.0), 1.0, 0.03);
    EXPECT_FALSE(onset_of(2.0, 2.1).has_value()) << "one window is a stroke that turns round";
    EXPECT_FALSE(onset_of(5.0, 6.0).has_value());
}

TEST(ForceMeasures, LeaveOutATenthOfTheWindowsWhereForceRightlyChangesFast) {
    std::vector<ForceWindow> windows(100, ForceWindow{.fast_rms_n = 0.05});
    for (std::size_t i = 0; i < 9; ++i) windows[10 * i].fast_rms_n = 1.0;
    EXPECT_DOUBLE_EQ(limit_cycle_n(windows), 0.05);
    for (std::size_t i = 0; i < 9; ++i) windows[10 * i + 5].fast_rms_n = 1.0;
    EXPECT_DOUBLE_EQ(limit_cycle_n(windows), 1.0);
    EXPECT_EQ(limit_cycle_n({}), 0.0);
}

TEST(ForceMeasures, AverageTheForcesLength) {
    const ForceRecord record{{.force_n = {0.0, 3.0, 4.0}}, {.force_n = {1.0, 0.0, 0.0}}};
    EXPECT_DOUBLE_EQ(mean_force_n(record), 3.0);
    EXPECT_EQ(mean_force_n(ForceRecord()), 0.0);
}

}  // namespace
}  // namespace osteomill::study
