#include "analysis/calibration/coefficient_fit.h"

#include <gmock/gmock.h>

#include <array>

#include "tests/unit/studies/calibration/synthetic_runs.h"

namespace osteomill::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

TEST(CoefficientFit, FindsExactForcesCoefficientsExactly) {
    const CoefficientFit fit = fit_coefficients(exact_forces(twelve_settings(), 0.1));
    EXPECT_LT((fit.value - known_coefficients()).norm(), 1e-9);
    EXPECT_LT(fit.chi_squared, 1e-15);
    EXPECT_EQ(fit.degrees_of_freedom, 30);
    EXPECT_EQ(fit.widened_by, 1.0);
}

/// In how many of `sets` data sets each coefficient lies in its interval, percent.
std::array<double, 6> coverage_percent(double noise, int sets, std::uint64_t seed) {
    const FitInput exact = exact_forces(twelve_settings(), 0.05);
    std::mt19937_64 random(seed);
    std::array<double, 6> percent{};
    for (int set = 0; set < sets; ++set) {
        const CoefficientFit fit = fit_coefficients(with_noise(exact, noise, random));
        for (Eigen::Index i = 0; i < coefficient_count; ++i)
            if (std::abs(fit.value(i) - known_coefficients()(i)) <= fit.half_width(i))
                percent[static_cast<std::size_t>(i)] += 100.0 / sets;
    }
    return percent;
}

TEST(CoefficientFit, HoldsTheTruthInNinetyFiveOfAHundredIntervals) {
    // 1000 sets: one standard deviation of the share is 0.7 %.
    for (const double percent : coverage_percent(1.0, 1000, 20)) {
        EXPECT_GE(percent, 93.0);
        EXPECT_LE(percent, 97.0);
    }
}

TEST(CoefficientFit, WidensIntervalsWhereForcesScatterMoreThanTheirSpreadsSay) {
    for (const double percent : coverage_percent(3.0, 1000, 21)) {
        EXPECT_GE(percent, 93.0);
        EXPECT_LE(percent, 97.0);
    }
    std::mt19937_64 random(1);
    const CoefficientFit fit =
        fit_coefficients(with_noise(exact_forces(twelve_settings(), 0.05), 3.0, random));
    EXPECT_NEAR(fit.widened_by, 3.0, 1.0);
    EXPECT_LT(fit.probability, 1e-6);
}

TEST(CoefficientFit, BelievesForcesByTheirSpreads) {
    FitInput input = exact_forces(twelve_settings(), 0.05);
    // A run that is wrong by 5 N and known to be so bad.
    input.force_n.head(3).array() += 5.0;
    input.spread_n.head(3).setConstant(1000.0);
    EXPECT_LT(
        (fit_coefficients(input).value - known_coefficients()).cwiseQuotient(known_coefficients()).norm(),
        1e-3);
}

std::vector<RunSetting> of_one_feed_and_depth() {
    std::vector<RunSetting> settings;
    for (const double direction_deg : {0.0, 60.0, 120.0, 180.0, 240.0, 300.0})
        settings.push_back({.tilt_deg = 10.0, .tilt_direction_deg = direction_deg});
    return settings;
}

TEST(CoefficientFit, RefusesWhatTheRunsCannotTellApart) {
    EXPECT_THAT([] { fit_coefficients(exact_forces(of_one_feed_and_depth(), 0.01)); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("cannot tell K_r, K_re apart"), HasSubstr("feed of a revolution"))));
    EXPECT_GT(scaled_condition(exact_forces(of_one_feed_and_depth(), 1e-6)), largest_condition)
        << "small spreads make no design better";
}

TEST(CoefficientFit, RefusesDirectionsThatOneDepthConfounds) {
    std::vector<RunSetting> feeds;
    for (const double feed_mm_per_s : {1.0, 3.0, 12.0, 24.0})
        feeds.push_back({.feed_mm_per_s = feed_mm_per_s});
    FitInput input = exact_forces(feeds, 0.01);
    // Nothing is known of the upward force, and that along the feed is one sum of K_r and K_a at one depth.
    for (Eigen::Index row = 2; row < input.spread_n.size(); row += 3) input.spread_n(row) = 1e6;
    EXPECT_THAT([&] { fit_coefficients(input); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("K_r"), HasSubstr("K_a"), Not(HasSubstr("K_t")), HasSubstr("apart"))));
}

TEST(CoefficientFit, RefusesOneFeedHoweverTheRunsDifferOtherwise) {
    std::vector<RunSetting> settings;
    for (const double depth_mm : {0.1, 0.5, 2.0})
        for (const double tilt_deg : {0.0, 45.0})
            for (const double faster : {1.0, 2.0})
                settings.push_back({.rpm = 10'000.0 * faster,
                                    .feed_mm_per_s = 4.0 * faster,
                                    .depth_mm = depth_mm,
                                    .tilt_deg = tilt_deg});
    EXPECT_THAT([&] { refuse_one_feed(settings); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("3 to 3 um"), HasSubstr("cannot be told apart"), HasSubstr("2 times"))));
    settings.front().feed_mm_per_s *= 2.0;
    EXPECT_NO_THROW(refuse_one_feed(settings));
}

TEST(CoefficientFit, RefusesFewerForcesThanItCanCheck) {
    auto two = twelve_settings();
    two.resize(2);
    EXPECT_THAT([&] { fit_coefficients(exact_forces(two, 0.1)); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("6 forces of 2 runs"), HasSubstr("at least 3 runs"))));
}

TEST(CoefficientFit, RefusesIntervalsThatTellNothing) {
    EXPECT_THAT([] { fit_coefficients(exact_forces(twelve_settings(), 100.0)); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("the interval of"), HasSubstr("would tell nothing"))));
}

TEST(CoefficientFit, PredictsEachRunByTheOthers) {
    const FitInput exact = exact_forces(twelve_settings(), 0.05);
    FitInput spoiled = exact;
    spoiled.force_n(3) += 10.0;  // the second run, along the feed
    const auto predictions = predictions_without_each_run(spoiled);
    ASSERT_EQ(predictions.size(), 12u);
    ASSERT_TRUE(predictions[1].has_value());
    EXPECT_LT((*predictions[1] - exact.force_n.segment<3>(3)).norm(), 1e-9) << "what is wrong is left out";
    ASSERT_TRUE(predictions[2].has_value());
    EXPECT_GT((*predictions[2] - exact.force_n.segment<3>(6)).norm(), 0.01);
}

TEST(CoefficientFit, SaysWhichRunAloneCarriesACoefficient) {
    auto settings = of_one_feed_and_depth();
    settings.push_back({.feed_mm_per_s = 60.0, .tilt_deg = 10.0});
    const auto predictions = predictions_without_each_run(exact_forces(settings, 0.05));
    ASSERT_EQ(predictions.size(), 7u);
    EXPECT_TRUE(predictions.front().has_value());
    EXPECT_FALSE(predictions.back().has_value());
}

}  // namespace
}  // namespace osteomill::study
