// Metrics of the hand's motion: time, idle time, path, smoothness. Definitions: docs/metrics.md.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

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

/// Smoothness of a motion: its log dimensionless jerk, of positions at a rate of 30 Hz or so.
///
///     LDLJ = -ln( T^3 / v_peak^2 * integral over T of |d^3 x / dt^3|^2 dt )
///
/// Dimensionless, so neither size nor speed of a motion counts; nearer to zero is smoother. A reach of least
/// jerk (Flash and Hogan 1985) has -ln 204.8 = -5.32. Hogan and Sternad, "Sensitivity of smoothness measures
/// to movement duration, amplitude, and arrests", Journal of Motor Behavior 41 (2009); in this form
/// Balasubramanian, Melendez-Calderon and Burdet, IEEE Transactions on Biomedical Engineering 59 (2012), and
/// Balasubramanian et al., Journal of NeuroEngineering and Rehabilitation 12:112 (2015).
///
/// The jerk between four samples in a row is six times their third divided difference, which is exact for a
/// cubic at any spacing. It holds from the second to the third of them; the first and the last of a motion
/// hold to its ends. Peak speed is that between two samples in a row.
struct TimedPosition {
    double time_s = 0.0;
    glm::dvec3 position_mm{0.0};
};

/// Times ascend; a sample whose time does not is left out. Nothing for fewer than five samples, and if
/// nothing moves or the acceleration never changes.
std::optional<double> log_dimensionless_jerk(std::span<const TimedPosition> motion);

/// Smoothness as a person sees it: the number N of equal reaches in a row, each from rest to rest, that are
/// as jerky as the motion. N reaches have N^4 times the dimensionless jerk of one: N = (exp(-LDLJ) /
/// 204.8)^(1/4).
double reaches_in_a_row(double log_dimensionless_jerk);

/// "flowing" up to 1.5 of them a second, "smooth" up to 3, "uneven" up to 6, "jerky": hands correct a motion
/// once or twice a second, and tremble at 8 to 12 Hz.
const char* smoothness_word(double reaches_per_s);

}  // namespace osteomill
