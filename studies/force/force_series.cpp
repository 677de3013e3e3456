#include "studies/force/force_series.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace osteomill::study {

namespace {

glm::dvec3 mean_of(std::span<const glm::dvec3> values) {
    if (values.empty()) return glm::dvec3(0.0);
    return std::accumulate(values.begin(), values.end(), glm::dvec3(0.0)) /
           static_cast<double>(values.size());
}

}  // namespace

glm::dvec3 mean_force_n(const ForceSeries& series) {
    return mean_of(series.force_n);
}

double removal_mm3_per_s(const ForceSeries& series) {
    if (series.removed_mm3.empty()) return 0.0;
    return std::accumulate(series.removed_mm3.begin(), series.removed_mm3.end(), 0.0) /
           (series.step_s * static_cast<double>(series.removed_mm3.size()));
}

double relative_error(const glm::dvec3& value, const glm::dvec3& reference) {
    const double difference = glm::length(value - reference);
    const double norm = glm::length(reference);
    if (norm > 0.0) return difference / norm;
    return difference > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

std::vector<double> deviations(const ForceSeries& series, double window_s) {
    const auto window = static_cast<std::size_t>(std::max(1.0, std::round(window_s / series.step_s)));
    const glm::dvec3 mean = mean_force_n(series);
    std::vector<double> shares;
    if (mean == glm::dvec3(0.0)) return shares;
    for (std::size_t first = 0; first + window <= series.force_n.size(); first += window)
        shares.push_back(glm::distance(mean_of(std::span(series.force_n).subspan(first, window)), mean) /
                         glm::length(mean));
    return shares;
}

double ripple(const ForceSeries& series, double window_s) {
    const std::vector<double> shares = deviations(series, window_s);
    if (shares.empty()) return 0.0;
    return std::sqrt(std::inner_product(shares.begin(), shares.end(), shares.begin(), 0.0) /
                     static_cast<double>(shares.size()));
}

double largest_step(const ForceSeries& series) {
    const double mean_n = glm::length(mean_force_n(series));
    double largest_n = 0.0;
    for (const glm::dvec3& force_n : series.force_n) largest_n = std::max(largest_n, glm::length(force_n));
    return mean_n > 0.0 ? largest_n / mean_n : 0.0;
}

double log_log_slope(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.size() < 2)
        throw std::invalid_argument("a slope needs two points or more, each with x and y");
    const auto n = static_cast<double>(x.size());
    double sum_x = 0.0;
    double sum_y = 0.0;
    double sum_xx = 0.0;
    double sum_xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0.0) || !(y[i] > 0.0))
            throw std::invalid_argument("a logarithm needs values above zero");
        const double lx = std::log(x[i]);
        const double ly = std::log(y[i]);
        sum_x += lx;
        sum_y += ly;
        sum_xx += lx * lx;
        sum_xy += lx * ly;
    }
    const double spread = n * sum_xx - sum_x * sum_x;
    if (!(spread > 1e-12)) throw std::invalid_argument("a slope needs x to vary");
    return (n * sum_xy - sum_x * sum_y) / spread;
}

}  // namespace osteomill::study
