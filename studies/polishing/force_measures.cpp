#include "studies/polishing/force_measures.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numeric>

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
template <typename Value>
std::vector<Value> moving_mean(const std::vector<Value>& values, std::size_t width) {
    std::vector<Value> sums{Value(0.0)};
    for (const Value& value : values) sums.push_back(sums.back() + value);
    std::vector<Value> means;
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

std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        for (std::size_t i = first; i < end; ++i)
            ranks[order[i]] = 0.5 * static_cast<double>(first + end - 1);
        first = end;
    }
    return ranks;
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
            window.time_s += sample.time_s;
            window.depth_mm += sample.depth_mm;
            window.slow_rms_n += slow[i] * slow[i];
            fast_squared += glm::dot(fast, fast);
        }
        const auto count = static_cast<double>(length);
        window.time_s /= count;
        window.depth_mm /= count;
        window.slow_rms_n = glm::sqrt(window.slow_rms_n / count);
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

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
    const std::vector<double> x_ranks = ranks_of(x);
    const std::vector<double> y_ranks = ranks_of(y);
    const double middle = 0.5 * (static_cast<double>(x.size()) - 1.0);
    double xx = 0.0;
    double yy = 0.0;
    double xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x_ranks[i] - middle) * (x_ranks[i] - middle);
        yy += (y_ranks[i] - middle) * (y_ranks[i] - middle);
        xy += (x_ranks[i] - middle) * (y_ranks[i] - middle);
    }
    return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

double share_off_line(const ForceRecord& record) {
    Eigen::Matrix3d power = Eigen::Matrix3d::Zero();
    for (const RecordedForce& sample : record) {
        const Eigen::Vector3d force(sample.force_n.x, sample.force_n.y, sample.force_n.z);
        power += force * force.transpose();
    }
    const Eigen::Vector3d squares = power.diagonal();
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double scale = std::sqrt(squares(i) * squares(k));
            power(i, k) = scale > 0.0 ? power(i, k) / scale : 0.0;
        }
    }
    const double whole = power.trace();
    if (whole <= 0.0) return 0.0;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(power, Eigen::EigenvaluesOnly);
    return std::max(0.0, 1.0 - axes.eigenvalues()(2) / whole);
}

double peak_over_mean(const ForceRecord& record, double around_s) {
    std::vector<double> lengths;
    for (const RecordedForce& sample : record) lengths.push_back(glm::length(sample.force_n));
    const std::vector<double> means = moving_mean(lengths, samples_in(record, around_s));
    std::vector<double> ratios;
    for (std::size_t i = 0; i < lengths.size(); ++i)
        if (means[i] > 0.0) ratios.push_back(lengths[i] / means[i]);
    return quantile(std::move(ratios), 0.99);
}

}  // namespace osteomill::study
