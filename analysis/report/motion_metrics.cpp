#include "analysis/report/motion_metrics.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "analysis/report/smoothness.h"
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
    glm::dvec3 leaps_mm(0.0);
    glm::dvec3 hand_mm_per_s(0.0);
    hand.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const TraceSample& now = samples[i];
        const double dt_s = trace.dt_s(i);
        if (trace.leaps(i))
            leaps_mm += now.hand_mm - samples[i - 1].hand_mm - dt_s * hand_mm_per_s;
        else if (dt_s > 0.0)
            hand_mm_per_s = (now.hand_mm - samples[i - 1].hand_mm) / dt_s;
        if (!now.is_paused) hand.push_back({now.time_s, now.hand_mm - leaps_mm});
        for (const TraceMoment& moment : now.moments)
            if (moment.spindle_on) metrics.depth_mm = std::max(metrics.depth_mm, moment.depth_mm);
        if (i == 0 || dt_s <= 0.0) continue;
        metrics.time_s += dt_s;
        if (now.is_paused) {
            metrics.paused_s += dt_s;
            continue;
        }
        const double hand_mm = trace.leaps(i) ? 0.0 : glm::length(now.hand_mm - samples[i - 1].hand_mm);
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

}  // namespace osteomill
