// The force within the tooth period, equation (1), and its mean, equation (2), for burrs with more and fewer
// edges and for faster and slower spindles: the milling model alone, on rails, so that each meets the same
// bone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "studies/polishing/force_record.h"
#include "studies/polishing/polishing_setup.h"

namespace osteomill::study {

struct ToothPeriodForce {
    PolishingSetup setup;
    double mean_n = 0.0;          ///< equation (2): of |F| averaged over tooth periods
    double one_tooth_n = 0.0;     ///< of one tooth, averaged over its revolution: mean_n / edges
    double peak_over_mean = 1.0;  ///< equation (1): force_measures.h
    ForceRecord clip{};           ///< some tooth periods, halfway through the slide
    double chip_um = 0.0;         ///< a tooth's feed, |v| / (edges n): the thickest chip it can cut
};
/// What was measured, without the set-up.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToothPeriodForce, mean_n, one_tooth_n, peak_over_mean, clip, chip_um)

/// Edges of a slow burr, milled at 10 kHz: time-resolved.
std::vector<PolishingSetup> setups_by_edges(bool quick);

/// Spindle speeds with six edges, milled at 1 kHz: the mean only.
std::vector<PolishingSetup> setups_by_speed(bool quick);

/// On rails; the session's log goes to `log`. Throws as run_on_rails() does.
ToothPeriodForce measure(const Specimen& cube, const PolishingSetup& setup, const std::filesystem::path& log);

Table table_of(const std::vector<ToothPeriodForce>& forces);
/// The clip: time from its beginning and length of the force.
Table clip_of(const ToothPeriodForce& force);

}  // namespace osteomill::study
