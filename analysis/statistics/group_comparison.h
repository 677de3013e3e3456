// Two independent groups compared: Welch's t for measures, the exact rank test of Mann and Whitney for
// counts.
//
// Welch: means may differ in variance; degrees of freedom of Welch (Biometrika 34, 1947) and Satterthwaite.
// Effect size is Hedges' g: the difference of means over the pooled standard deviation, times the correction
// for small samples, in its exact form (Hedges, Journal of Educational Statistics 6, 1981).
//
// Mann and Whitney (Annals of Mathematical Statistics 18, 1947): p is exact for the ranks at hand, ties as
// midranks, by counting all ways to deal them out; twice the smaller tail. Effect size is Cliff's delta: the
// chance that a value of the first group is above one of the second, less the chance that it is below.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "analysis/statistics/mean_interval.h"

namespace osteomill {

struct WelchComparison {
    double difference = 0.0;  ///< of means, first less second
    Interval interval{};      ///< of the difference
    double t = 0.0;
    double degrees = 0.0;
    double p = 1.0;  ///< two-sided
    double hedges_g = 0.0;
};

/// Nothing where a group has fewer than two values, or neither varies.
std::optional<WelchComparison> compare_means(std::span<const double> first, std::span<const double> second);

struct RankComparison {
    double u = 0.0;  ///< of the first group: pairs in which it is above, ties half
    double p = 1.0;  ///< two-sided
    double cliffs_delta = 0.0;
};

/// More values than this in both groups together are not counted through.
inline constexpr std::size_t most_ranked = 200;

/// Nothing where a group is empty, or there are more than most_ranked.
std::optional<RankComparison> compare_ranks(std::span<const double> first, std::span<const double> second);

}  // namespace osteomill
