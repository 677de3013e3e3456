// Verdict on a run at a site: measures of the faults that a hand would not forgive.
#pragma once

#include "studies/stability/sites/site_run.h"

namespace osteomill::study {

/// While the spindle turns and has turned for settling_s; a model's force is its mean over mean_s.
struct SiteVerdict {
    /// The most energy that the hand got from any moment to any later one, less what a rigid burr on the
    /// hand's own way would have given.
    double energy_over_rigid_mj = 0.0;
    double energy_mj = 0.0;  ///< the same without the rigid burr's
    /// Longest time with more than 0.3 N on the hand while the model says less than 0.1.
    double stuck_ms = 0.0;
    /// Largest difference of the force's mean over mean_s to the model's, while bone takes energy from the
    /// burr; % of the model's largest mean there, or of least_peak_n.
    double error_percent = 0.0;
    /// The same while bone gives the burr energy. `implicit` keeps a part of that from the
    /// hand.
    double error_while_driven_percent = 0.0;
    double largest_jump_n = 0.0;  ///< between two ticks
    double peak_n = 0.0;
    /// Rms, over the ticks in contact, of the force less its mean over the mean_s before.
    double noise_n = 0.0;
};

inline constexpr double mean_s = 0.02;
inline constexpr double settling_s = 0.05;
inline constexpr double felt_n = 0.3;
inline constexpr double nearly_nothing_n = 0.1;
inline constexpr double least_peak_n = 0.2;

SiteVerdict verdict_on(const SiteRun& run);

}  // namespace osteomill::study
