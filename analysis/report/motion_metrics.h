// Metrics of the hand's motion: time, idle time, path, smoothness. Definitions: docs/metrics.md.
#pragma once

#include <optional>

#include "analysis/report/session_trace.h"

namespace osteomill {

/// Slower than this, with the spindle off, a hand is idle.
inline constexpr double idle_below_mm_per_s = 2.0;

struct MotionMetrics {
    double time_s = 0.0;  ///< from the first sample to the last
    double idle_s = 0.0;
    double paused_s = 0.0;
    double spindle_s = 0.0;
    double path_mm = 0.0;                     ///< of the hand, pauses left out
    std::optional<double> smoothness{};       ///< log dimensionless jerk of the hand, the whole session
    double cutting_s = 0.0;                   ///< in which bone was taken
    double cutting_speed_mm_per_s = 0.0;      ///< of the burr, mean while it takes bone
    double cutting_speed_p95_mm_per_s = 0.0;  ///< of the burr while it takes bone, 95th percentile
    double depth_mm = 0.0;                    ///< largest while the spindle turns
    double cutting_depth_mm = 0.0;            ///< mean while bone is taken
    /// Share of the time in which bone is taken, as far as the trainee's viewpoint is known.
    std::optional<double> burr_in_view_share{};
    std::optional<double> cutting_angle_deg{};  ///< of the spindle to the surface, mean while bone is taken
};

MotionMetrics motion_metrics(const SessionTrace& trace);

}  // namespace osteomill
