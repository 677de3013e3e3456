#include "analysis/statistics/mean_interval.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace osteomill {

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sample_variance(std::span<const double> values) {
    if (values.size() < 2) return 0.0;
    const double mean = mean_of(values);
    const double squares = std::accumulate(values.begin(), values.end(), 0.0, [&](double sum, double value) {
        return sum + (value - mean) * (value - mean);
    });
    return squares / static_cast<double>(values.size() - 1);
}

double interval_errors(double degrees) {
    return boost::math::quantile(boost::math::students_t(degrees), 0.5 + 0.5 * confidence);
}

double two_sided_p(double t, double degrees) {
    return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(degrees), std::abs(t)));
}

std::optional<MeanInterval> mean_interval(std::span<const double> values) {
    if (values.empty()) return std::nullopt;
    MeanInterval result{.n = values.size(), .mean = mean_of(values)};
    if (result.n < 2) return result;
    const auto n = static_cast<double>(result.n);
    const double half = interval_errors(n - 1.0) * std::sqrt(sample_variance(values) / n);
    result.interval = {result.mean - half, result.mean + half};
    return result;
}

}  // namespace osteomill
