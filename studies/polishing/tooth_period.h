// The force within the tooth period, equation (1), and its mean, equation (2), for burrs with more and fewer
// edges and for faster and slower spindles: the milling model alone, on rails, so that each meets the same
// bone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "common/bone/bone.h"
#include "common/program/progress.h"
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

/// Edges of a slow burr, milled at 10 kHz: time-resolved.
std::vector<ToothPeriodForce> vary_edges(const Specimen& cube, bool quick,
                                         const std::filesystem::path& folder, const ReportProgress& progress);

/// Spindle speeds with six edges, milled at 1 kHz: the mean only.
std::vector<ToothPeriodForce> vary_speed(const Specimen& cube, bool quick,
                                         const std::filesystem::path& folder, const ReportProgress& progress);

Table table_of(const std::vector<ToothPeriodForce>& forces);
/// The clip: time from its beginning and length of the force.
Table clip_of(const ToothPeriodForce& force);

}  // namespace osteomill::study
