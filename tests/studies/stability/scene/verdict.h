// Is a run stable? It is where
//
//   - it did not go astray,
//   - the fast part of its force (fast_part.h) stays, beyond the truth's, below max(0.03 N, 5 % of the mean)
//     rms over the judged window: 0.03 N is what a finger on a stylus just feels on top of a force of about
//     1 N, and a third of the smallest limit cycle in the reference's table,
//   - that fast part does not grow: in the window's second half it is no more than half as large again as in
//     the first, or still below a third of the limit,
//   - the force gave back no more energy than it may have stored: the largest drawdown of the energy that it
//     took (EnergyLedger's rule), less that of the truth and less F^2 / 2K of the largest force on the
//     spring that the method renders, is below 0.25 mJ or a tenth of what the run took, if that is more. A
//     hand cannot tell 0.25 mJ (1 N over a quarter of a millimetre) from its own tremor.
//
// Slow sway and the hand's own swing are in the truth, and pass the first test; a swing that a method drives
// fails the last.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace osteomill::study {

/// One tick for each entry from the release on; run and truth of the same length unless the run went astray.
struct JudgedRun {
    std::span<const glm::dvec3> force_n;
    std::span<const double> taken_mj;  ///< by the force, from the release to the next tick
    std::span<const glm::dvec3> truth_force_n;
    std::span<const double> truth_taken_mj;
    std::size_t window_begins = 0;  ///< at least fit_reach_ticks
    std::size_t window_ends = 0;    ///< at least fit_reach_ticks before the end
    double spring_n_per_mm = 0.0;   ///< that the method renders; 0: none
    bool is_astray = false;
};

struct Verdict {
    bool is_stable = false;
    double limit_cycle_n =
        0.0;  ///< rms of the fast part beyond the truth's (root of the difference of squares)
    double injected_mj = 0.0;
};

Verdict verdict_on(const JudgedRun& run);

inline constexpr double least_limit_cycle_n = 0.03;
inline constexpr double limit_cycle_share = 0.05;
inline constexpr double growth_factor = 1.5;
inline constexpr double least_injection_mj = 0.25;
inline constexpr double injection_share = 0.1;

}  // namespace osteomill::study
