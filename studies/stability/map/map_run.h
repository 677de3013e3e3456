// A run of one case of the stability map: the program's own loops, coupling and milling model (MillingSession
// on its virtual clock) on the bench's device, beside the truth of the same scene and hand.
#pragma once

#include <string>
#include <vector>

#include "studies/stability/map/map_case.h"
#include "studies/stability/map/scene_cache.h"

namespace osteomill::study {

/// Outcome of a run of a MapCase, beside the continuous-time truth of the same scene and hand.
struct MapOutcome {
    double resistance_n_s_per_m = 0.0;  ///< cutting: |F| / feed of the steady slot; wall: 0
    double truth_mean_n = 0.0;          ///< |mean force| of the truth in the window that is judged

    bool is_stable = false;       ///< stability_verdict.h
    double limit_cycle_n = 0.0;   ///< rms of the force's fast part, beyond the truth's
    double injected_mj = 0.0;     ///< energy that the hand received beyond its own input
    double rms_error_n = 0.0;     ///< force against the truth's, tick by tick
    double mean_error_n = 0.0;    ///< |mean force - truth's mean force|
    double peak_n = 0.0;          ///< largest force on the hand
    double largest_jump_n = 0.0;  ///< between two ticks
    double depth_error_mm = 0.0;  ///< the burr's place across the surface, rms, against the truth's
    double removed_mm3 = 0.0;     ///< bone that was cut in the window
    double max_residual_n = 0.0;  ///< largest force left over by a contact solve
    double fallbacks = 0.0;       ///< ticks without a balance, until they were damped
    double energy_faults = 0.0;   ///< how often the force was off for the energy that it gave the hand

    bool operator==(const MapOutcome&) const = default;
};

/// Throws std::invalid_argument for a case that the session refuses (an unknown method, a rate out of range).
/// Cases may share a cache and run in several threads.
MapOutcome run_map_case(const MapCase& c, SceneCache& cache);

/// With nothing to share.
MapOutcome run_map_case(const MapCase& c);

// Time that a coupling takes for a haptic tick, apart from the loop that it runs in.

/// Microseconds of each of `ticks` ticks, of a hand that leads a 5 mm burr along a slot of 1 mm at 6 mm/s and
/// 10 000 rpm; milled after each, with the engagement that the coupling asks for. Throws as make_coupling().
std::vector<double> coupling_tick_us(const std::string& method, int ticks);

}  // namespace osteomill::study
