// The published polishing experiment: figures 6, 7 and 8.
#pragma once

#include <filesystem>

#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct PolishingStudyOptions {
    std::filesystem::path out;
    bool quick = false;            ///< fewer runs: half a minute at most
    bool has_edge_forces = false;  ///< burrs whose edges rub with 0.3 N/mm; else the published law
};

/// Writes figures.csv, a table a run and charts (SVG) into `options.out`, and the
/// logs of the sessions into its folder `runs`. Throws std::runtime_error in one line naming what cannot be
/// written.
void run_polishing_study(const PolishingStudyOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
