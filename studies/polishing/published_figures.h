// The runs behind the paper's figures 6, 7 and 8: cutting depth, the force of the milling model and that of
// the point spring against time, each through several couplings.
#pragma once

#include <vector>

#include "analysis/output/table.h"
#include "studies/polishing/polishing_run.h"

namespace osteomill::study {

/// For the simulated hand: the milling model through the published couplings at 100 Hz and through `implicit`
/// at 1 kHz, and the point spring through the published ones. `quick` leaves `hold` out.
std::vector<PolishingSetup> setups_of_figures(bool quick);

/// Time from first contact, depth and force, a line every few milliseconds of a record of one a millisecond.
Table series_of(const ForceRecord& record);
/// The slide without an arm or bone: time from first contact, and depth.
Table as_meant(const Scene& scene);
/// A line a run: slide, depth, stray, force, limit cycle, depth at which chatter begins, faults.
Table table_of(const std::vector<PolishingSetup>& setups, const std::vector<PolishingRun>& runs);

}  // namespace osteomill::study
