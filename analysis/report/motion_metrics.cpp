#include "analysis/report/motion_metrics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "common/statistics/percentile.h"

namespace osteomill {

MotionMetrics motion_metrics(const SessionTrace& trace) {
    MotionMetrics metrics;
    const auto& samples = trace.samples;
    std::vector<TimedPosition> hand;
    std::vector<double> cutting_speeds;
    double cutting_path_mm = 0.0;
    double depth_integral = 0.0;
    double angle_integral = 0.0;
    double angle_s = 0.0;
    double in_view_s = 0.0;
    double looked_s = 0.0;
    // The sum of all placements, which the hand did not make. During one the hand is assumed to go on as
    // before: a stop and a new start would count as a jerk.
    glm::dvec3 placed_mm(0.0);
    glm::dvec3 hand_mm_per_s(0.0);
    hand.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const TraceSample& now = samples[i];
        const double dt_s = trace.dt_s(i);
        if (trace.is_discontinuous(i))
            placed_mm += now.hand_mm - samples[i - 1].hand_mm - dt_s * hand_mm_per_s;
        else if (dt_s > 0.0)
            hand_mm_per_s = (now.hand_mm - samples[i - 1].hand_mm) / dt_s;
        if (!now.is_paused) hand.push_back({now.time_s, now.hand_mm - placed_mm});
        for (const TraceMoment& moment : now.moments)
            if (moment.spindle_on) metrics.depth_mm = std::max(metrics.depth_mm, moment.depth_mm);
        if (i == 0 || dt_s <= 0.0) continue;
        metrics.time_s += dt_s;
        if (now.is_paused) {
            metrics.paused_s += dt_s;
            continue;
        }
        const double hand_mm =
            trace.is_discontinuous(i) ? 0.0 : glm::length(now.hand_mm - samples[i - 1].hand_mm);
        metrics.path_mm += hand_mm;
        for (const TraceMoment& moment : now.moments)
            if (moment.spindle_on) metrics.spindle_s += moment.dt_s;
        if (!now.spindle_on && hand_mm < idle_below_mm_per_s * dt_s) metrics.idle_s += dt_s;
        if (!now.cuts()) continue;
        const double burr_mm = glm::length(now.burr_mm - samples[i - 1].burr_mm);
        metrics.cutting_s += dt_s;
        cutting_path_mm += burr_mm;
        for (const TraceMoment& moment : now.moments) depth_integral += moment.depth_mm * moment.dt_s;
        if (now.spindle_to_surface_deg) {
            angle_integral += *now.spindle_to_surface_deg * dt_s;
            angle_s += dt_s;
        }
        if (now.burr_in_view) {
            looked_s += dt_s;
            in_view_s += *now.burr_in_view ? dt_s : 0.0;
        }
        cutting_speeds.push_back(burr_mm / dt_s);
    }
    metrics.smoothness = log_dimensionless_jerk(hand);
    if (metrics.cutting_s > 0.0) {
        metrics.cutting_speed_mm_per_s = cutting_path_mm / metrics.cutting_s;
        metrics.cutting_depth_mm = depth_integral / metrics.cutting_s;
    }
    if (looked_s > 0.0) metrics.burr_in_view_share = in_view_s / looked_s;
    if (angle_s > 0.0) metrics.cutting_angle_deg = angle_integral / angle_s;
    metrics.cutting_speed_p95_mm_per_s = percentile(std::move(cutting_speeds), 0.95);
    return metrics;
}

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
