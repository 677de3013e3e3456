// Is a run stable? It is where
//
//   - it did not go astray,
//   - the fast part of its force (fast_part.h), beyond the truth's, stays below max(0.03 N, 5 % of the mean)
//     rms over the judged window, or is dying: a quarter less in the window's second half than in its first,
//   - that fast part does not grow: half as large again in the second half, and above a third of the limit,
//   - the force gave back no more energy than it may have stored: the largest drawdown of the energy that it
//     took (EnergyLedger's rule), less that of the truth and less F^2 / 2K of the largest force on the
//     spring that the method renders, stays below 0.25 mJ or a tenth of what the run took, if that is more.
//
// The numbers. 0.03 N on top of about 1 N is at the edge of what fingers on a stylus tell apart, and an
// eighth of the smallest limit cycle in the project's table of chatter. A ring that dies is not a limit
// cycle: a wall that a hold renders at 0.9 of its edge rings for seconds, and dies; at 1.1 of it the ring
// grows. 0.25 mJ is 1 N over a quarter of a millimetre, about a hand's tremor; chatter at the motors' limit
// gives back several millijoules in half a second. Slow sway and the hand's own swing are in the truth, and
// too slow for the fast part; a slow swing that a method drives fails by its energy.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace osteomill::study {

/// One tick for each entry from the release on.
struct JudgedRun {
    std::span<const glm::dvec3> force_n;  ///< ends early where the run went astray
    std::span<const double> taken_mj;     ///< by the force, from the release to the next tick
    std::span<const glm::dvec3> truth_force_n;
    std::span<const double> truth_taken_mj;
    /// Judged are ticks [begins, ends); of a run that ended before, what there is of its second half.
    std::size_t window_begins = 0;
    std::size_t window_ends = 0;
    double spring_n_per_mm = 0.0;  ///< that the method renders; 0: none
    bool is_astray = false;
};

struct Verdict {
    bool is_stable = false;
    double limit_cycle_n = 0.0;  ///< root of the difference of the mean squares of both fast parts
    double injected_mj = 0.0;
};

Verdict verdict_on(const JudgedRun& run);

inline constexpr double least_limit_cycle_n = 0.03;
inline constexpr double limit_cycle_share = 0.05;
inline constexpr double dying_factor = 0.75;
inline constexpr double growing_factor = 1.5;
inline constexpr double least_injection_mj = 0.25;
inline constexpr double injection_share = 0.1;

}  // namespace osteomill::study
