// Smoothness of a motion: its log dimensionless jerk, of positions at a rate of 30 Hz or so.
//
//     LDLJ = -ln( T^3 / v_peak^2 * integral over T of |d^3 x / dt^3|^2 dt )
//
// Dimensionless, so neither size nor speed of a motion counts; nearer to zero is smoother. A reach of least
// jerk (Flash and Hogan 1985) has -ln 204.8 = -5.32. Hogan and Sternad, "Sensitivity of smoothness measures
// to movement duration, amplitude, and arrests", Journal of Motor Behavior 41 (2009); in this form
// Balasubramanian, Melendez-Calderon and Burdet, IEEE Transactions on Biomedical Engineering 59 (2012), and
// Balasubramanian et al., Journal of NeuroEngineering and Rehabilitation 12:112 (2015).
//
// The jerk between four samples in a row is six times their third divided difference, which is exact for a
// cubic at any spacing. It holds from the second to the third of them; the first and the last of a motion
// hold to its ends. Peak speed is that between two samples in a row.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace osteomill {

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
