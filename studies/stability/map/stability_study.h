// The study of stability: the map, part by part or whole, and its tables and charts.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "analysis/output/surroundings.h"
#include "studies/stability/map/map_outcome.h"
#include "studies/stability/map/map_points.h"
#include "studies/stability/map/shard.h"

namespace osteomill::study {

struct StabilityStudyOptions {
    std::filesystem::path out = "study/stability";
    MapSelection selection{};
    Shard shard{};
    int jobs = 1;  ///< cases at a time
};

/// Runs one case. Thread-safe, and the same case always gives the same outcome.
using RunCase = std::function<MapOutcome(const MapCase&)>;

/// Runs the cases of a part that `options.out`, a folder that is there, does not hold yet; where the part is
/// the whole, writes its results as well. Throws std::runtime_error in one line naming what cannot be written
/// or read, or the case that failed.
void run_stability_study(const StabilityStudyOptions& options, const RunCase& run,
                         const StudySurroundings& surroundings);

/// Writes map.csv, map.json, the tables of the charts and the charts (SVG) of parts that ran before into the
/// folder `out`: to the byte what one process would have written. Throws as merge() does, and as above.
void merge_stability_study(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& out,
                           const StudySurroundings& surroundings);

}  // namespace osteomill::study
