// Verdict on the stability of a run. A run is stable where it did not go astray, the fast part of its force
// (fast_part, below) beyond the truth's does not grow, and either is small or dies. In numbers:
//
//   - grows: rms in the window's second half more than 1.5 times that in its first, and above a third of
//     what is small,
//   - small: rms over the window below max(0.03 N, 5 % of the mean), and half an encoder step of the rendered
//     spring on top of that, if there are any: a staircase is no limit cycle; and the force gave back no
//     more energy than it may have stored: the largest drawdown of the energy that it took (EnergyLedger's
//     rule), less that of the truth and less F^2 / 2K of the largest force on the spring that the method
//     renders, is below 0.25 mJ or a tenth of what the run took, if that is more,
//   - dies: the run, from the release on, is split into four equal parts; the first is not small, and each
//     other shows at most 0.85 of the one before.
//
// The numbers. 0.03 N on top of about 1 N is at the edge of what fingers on a stylus tell apart, and an
// eighth of the smallest limit cycle in the project's table of chatter. A ring that dies is no limit cycle:
// on a wall whose stiffness nears the edge of a hold it lasts for seconds. Chatter that grew first and is
// less by chance now has not been dying all along. 0.25 mJ is 1 N over a quarter of a millimetre, about a
// hand's tremor; chatter at the motors' limit gives back several millijoules in half a second. Slow sway and
// the hand's own swing are in the truth, and too slow for the fast part; a slow swing that a method drives
// fails by its energy. A ring that dies may have got energy from the force, only less than the hand took.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace osteomill::study {

// The fast part of a force: the residue of a parabola through 61 ticks. From each sample it subtracts the
// value there of the parabola that best fits the 30 ticks on either side (Savitzky and Golay, Analytical
// Chemistry 36:1627, 1964). The parabola follows motion slower than about 16 Hz at 1 kHz: less than a
// hundredth is left of the hand's own swing at 4 Hz, and nearly all at 25 Hz and above.

inline constexpr std::size_t fit_reach_ticks = 30;

/// The fast part of samples [reach, size - reach); empty for a signal that is shorter than the fit.
std::vector<glm::dvec3> fast_part(std::span<const glm::dvec3> signal);

/// Root of the mean squared length; 0 of nothing.
double rms(std::span<const glm::dvec3> signal);

/// One tick for each entry from the release on.
struct JudgedRun {
    std::span<const glm::dvec3> force_n;  ///< ends early where the run went astray
    std::span<const double> taken_mj;     ///< by the force, from the release to the next tick
    std::span<const glm::dvec3> truth_force_n;
    std::span<const double> truth_taken_mj;
    /// Judged are ticks [begins, ends), both at least fit_reach_ticks after the release and before the end;
    /// for a run that went astray, as much of its second half as there is.
    std::size_t window_begins = 0;
    std::size_t window_ends = 0;
    double spring_n_per_mm = 0.0;  ///< that the method renders; 0: none
    double encoder_step_mm = 0.0;  ///< 0: the device's position is read exactly
    bool is_astray = false;
};

struct Verdict {
    bool is_stable = false;
    /// Root of the difference of the mean squares of both fast parts; for a run too short for the fit, rms of
    /// its force about the truth's.
    double limit_cycle_n = 0.0;
    double injected_mj = 0.0;
};

Verdict verdict_on(const JudgedRun& run);

inline constexpr double least_limit_cycle_n = 0.03;
inline constexpr double limit_cycle_share = 0.05;
inline constexpr double dying_factor = 0.85;
inline constexpr double growing_factor = 1.5;
inline constexpr double least_injection_mj = 0.25;
inline constexpr double injection_share = 0.1;

}  // namespace osteomill::study
