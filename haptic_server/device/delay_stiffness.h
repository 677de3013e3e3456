// How stiff a coupling may be whose force comes late, as over a bridge between machines.
#pragma once

#include <algorithm>

namespace osteomill {

/// With more between a reading and its force the coupling's own damper shakes the arm, and no spring helps:
/// osteomill_study bridge.
inline constexpr double longest_delay_s = 0.003;

/// What of the stiffness that an arm renders by itself is left with `delay_s` between a reading and its
/// force; 1 up to a millisecond, a tick, with which the coupling reckons anyway. The stiffest wall that holds
/// on a bare arm, with the coupling's 4 N s/m through 1 ms, is 6.2, 2.27 and 1.35 N/mm at 0, 1 and 2 ticks
/// (docs/coupling.md): its inverse is 0.16 + 0.29 d mm/N, d in ms. The share keeps the same distance from
/// that edge, up to longest_delay_s. What is negative or no number counts as no delay.
inline double stiffness_share(double delay_s) {
    constexpr double at_once_mm_per_n = 0.16;
    constexpr double per_ms_mm_per_n = 0.29;
    const double delay_ms = delay_s > 0.0 ? 1000.0 * delay_s : 0.0;
    return std::min(1.0,
                    (at_once_mm_per_n + per_ms_mm_per_n) / (at_once_mm_per_n + per_ms_mm_per_n * delay_ms));
}

}  // namespace osteomill
