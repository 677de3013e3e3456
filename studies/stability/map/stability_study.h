// The study of stability: the map, its tables and charts.
#pragma once

#include <filesystem>
#include <functional>

#include "analysis/output/surroundings.h"
#include "studies/stability/map/map_outcome.h"
#include "studies/stability/map/map_points.h"

namespace osteomill::study {

/// Runs one case. Thread-safe, and the same case always gives the same outcome.
using RunCase = std::function<MapOutcome(const MapCase&)>;

/// Writes map.csv, map.json, the tables of the charts and the charts (SVG) into `out`. Throws
/// std::runtime_error in one line where nothing is selected, and as StudyRun does.
void run_stability_study(const MapSelection& selection, const RunCase& run_case,
                         const std::filesystem::path& out, const StudySurroundings& surroundings);

}  // namespace osteomill::study
