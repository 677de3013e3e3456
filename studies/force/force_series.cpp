#include "studies/force/force_series.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>

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

}  // namespace osteomill::study
