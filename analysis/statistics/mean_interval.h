// Mean of a sample with its confidence interval by Student's t, for values that are about normal.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace osteomill {

inline constexpr double confidence = 0.95;

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

struct MeanInterval {
    std::size_t n = 0;
    double mean = 0.0;
    std::optional<Interval> interval{};  ///< of the mean; nothing for fewer than two values
};

/// Nothing where there are no values.
std::optional<MeanInterval> mean_interval(std::span<const double> values);

double mean_of(std::span<const double> values);
/// With n - 1; 0 for fewer than two values.
double sample_variance(std::span<const double> values);

/// How many standard errors lie between an estimate and either end of its interval. `degrees` above 0.
double interval_errors(double degrees);
/// Two-sided p of Student's t.
double two_sided_p(double t, double degrees);

}  // namespace osteomill
