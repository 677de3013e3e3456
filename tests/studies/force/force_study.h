// The study of the milling force: survey, speed against accuracy, memory; its tables and charts.
#pragma once

#include <filesystem>

#include "tests/studies/report/surroundings.h"

namespace osteomill::study {

struct ForceStudyOptions {
    std::filesystem::path out;
    bool quick = false;  ///< fewer points and shorter runs: a minute at most
};

/// Writes force.json, the tables (CSV) and the charts (SVG) into `options.out`, a folder that is there.
/// Throws std::runtime_error in one line naming what cannot be written.
void run_force_study(const ForceStudyOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
