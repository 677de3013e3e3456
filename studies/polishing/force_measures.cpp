#include "studies/polishing/force_measures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill::study {

namespace {

/// Samples in a span; at least one.
std::size_t samples_in(const ForceRecord& record, double span_s) {
    if (record.size() < 2) return 1;
    const double period_s =
        (record.back().time_s - record.front().time_s) / static_cast<double>(record.size() - 1);
    return static_cast<std::size_t>(std::max(1.0, std::round(span_s / period_s)));
}

/// Centred moving mean of as many values on either side as make up about `width` in all.
std::vector<glm::dvec3> moving_mean(const std::vector<glm::dvec3>& values, std::size_t width) {
    std::vector<glm::dvec3> sums{glm::dvec3(0.0)};
    for (const glm::dvec3& value : values) sums.push_back(sums.back() + value);
    std::vector<glm::dvec3> means;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t first = i - std::min(i, width / 2);
        const std::size_t end = std::min(values.size(), i + width / 2 + 1);
        means.push_back((sums[end] - sums[first]) / static_cast<double>(end - first));
    }
    return means;
}

std::vector<glm::dvec3> forces_of(const ForceRecord& record) {
    std::vector<glm::dvec3> forces;
    for (const RecordedForce& sample : record) forces.push_back(sample.force_n);
    return forces;
}

/// The value that `share` of all are below.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

}  // namespace

std::vector<ForceWindow> windows_of(const ForceRecord& record, double window_s) {
    const std::vector<glm::dvec3> slow = moving_mean(forces_of(record), samples_in(record, slow_part_s));
    const std::size_t length = samples_in(record, window_s);
    std::vector<ForceWindow> windows;
    for (std::size_t first = 0; first + length <= record.size(); first += length) {
        ForceWindow window;
        double fast_squared = 0.0;
        for (std::size_t i = first; i < first + length; ++i) {
            const RecordedForce& sample = record[i];
            const glm::dvec3 fast = sample.force_n - slow[i];
            window.depth_mm += sample.depth_mm;
            fast_squared += glm::dot(fast, fast);
        }
        const auto count = static_cast<double>(length);
        window.depth_mm /= count;
        window.fast_rms_n = std::sqrt(fast_squared / count);
        windows.push_back(window);
    }
    return windows;
}

double limit_cycle_n(const std::vector<ForceWindow>& windows) {
    std::vector<double> fast;
    for (const ForceWindow& window : windows) fast.push_back(window.fast_rms_n);
    return quantile(std::move(fast), 0.9);
}

std::optional<double> onset_of_chatter_mm(const std::vector<ForceWindow>& windows) {
    const auto chatters = [](const ForceWindow& window) { return window.fast_rms_n >= chatter_n; };
    const auto onset = std::adjacent_find(
        windows.begin(), windows.end(),
        [&](const ForceWindow& one, const ForceWindow& next) { return chatters(one) && chatters(next); });
    return onset == windows.end() ? std::nullopt : std::optional(onset->depth_mm);
}

double mean_force_n(const ForceRecord& record) {
    double sum = 0.0;
    for (const RecordedForce& sample : record) sum += glm::length(sample.force_n);
    return record.empty() ? 0.0 : sum / static_cast<double>(record.size());
}

}  // namespace osteomill::study
