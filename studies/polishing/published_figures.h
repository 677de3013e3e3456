// The runs behind the paper's figures 6, 7 and 8: cutting depth, the force of the milling model and that of
// the point spring against time, each through several couplings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "studies/polishing/force_measures.h"
#include "studies/polishing/polishing_run.h"

namespace osteomill::study {

/// A run and what it is judged by.
struct FigureRun {
    PolishingSetup setup;
    PolishingRun run;
    std::vector<ForceWindow> windows{};
    double mean_force_n = 0.0;
    double limit_cycle_n = 0.0;
    std::optional<double> onset_mm{};  ///< depth at which chatter begins

    /// What the tables and the claims call it: "milling, interpolate".
    std::string name() const { return setup.force_model + ", " + setup.coupling; }
};

FigureRun judged(PolishingSetup setup, PolishingRun run);

/// For the simulated hand: the milling model through the published couplings at 100 Hz and through `implicit`
/// at 1 kHz, and the point spring through the published ones. `quick` leaves `hold` out.
std::vector<PolishingSetup> setups_of_figures(bool quick);

/// Time from first contact, depth and force, a line every few milliseconds of a record of one a millisecond.
Table series_of(const ForceRecord& record);
/// A line a run: slide, depth, stray, force, limit cycle, faults.
Table table_of(const std::vector<FigureRun>& figures);

}  // namespace osteomill::study
