#include "analysis/report/smoothness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace osteomill {

namespace {

using Samples = std::vector<TimedPosition>;

/// Only two frames of one tick are closer than a haptic tick.
constexpr double least_interval_s = 0.9e-3;

Samples in_order(std::span<const TimedPosition> motion) {
    Samples samples;
    for (const TimedPosition& sample : motion)
        if (samples.empty() || sample.time_s >= samples.back().time_s + least_interval_s)
            samples.push_back(sample);
    return samples;
}

/// f[i, i+1, ..., i+order], Newton's divided difference.
glm::dvec3 divided_difference(const Samples& s, std::size_t i, std::size_t order) {
    if (order == 0) return s[i].position_mm;
    return (divided_difference(s, i + 1, order - 1) - divided_difference(s, i, order - 1)) /
           (s[i + order].time_s - s[i].time_s);
}

}  // namespace

std::optional<double> log_dimensionless_jerk(std::span<const TimedPosition> motion) {
    const Samples s = in_order(motion);
    if (s.size() < 5) return std::nullopt;
    double peak_mm_per_s = 0.0;
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
        peak_mm_per_s = std::max(peak_mm_per_s, glm::length(divided_difference(s, i, 1)));
    double integral = 0.0;  // mm^2 / s^5
    const std::size_t last = s.size() - 4;
    for (std::size_t i = 0; i <= last; ++i) {
        const glm::dvec3 jerk = 6.0 * divided_difference(s, i, 3);
        const double from_s = s[i == 0 ? 0 : i + 1].time_s;
        const double to_s = s[i == last ? i + 3 : i + 2].time_s;
        integral += glm::dot(jerk, jerk) * (to_s - from_s);
    }
    const double duration_s = s.back().time_s - s.front().time_s;
    const double jerk = duration_s * duration_s * duration_s / (peak_mm_per_s * peak_mm_per_s) * integral;
    // Rounding leaves a jerk to a straight motion at constant speed.
    if (!(peak_mm_per_s > 0.0) || !std::isfinite(jerk) || jerk < 1e-6) return std::nullopt;
    return -std::log(jerk);
}

double reaches_in_a_row(double log_dimensionless_jerk) {
    return std::pow(std::exp(-log_dimensionless_jerk) / 204.8, 0.25);
}

const char* smoothness_word(double reaches_per_s) {
    if (reaches_per_s <= 1.5) return "flowing";
    if (reaches_per_s <= 3.0) return "smooth";
    return reaches_per_s <= 6.0 ? "uneven" : "jerky";
}

}  // namespace osteomill
