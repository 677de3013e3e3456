// Joins the parts of a map that ran apart.
#pragma once

#include <filesystem>
#include <vector>

#include "studies/stability/map/map_outcome.h"
#include "studies/stability/map/map_points.h"

namespace osteomill::study {

/// Points and outcomes, side by side, in the list's order.
struct WholeMap {
    MapSelection selection;
    std::vector<MapPoint> points;
    std::vector<MapOutcome> outcomes;
};

/// From files of cases and folders that hold them (cases-*.jsonl). Throws std::runtime_error in one line
/// where there is no file, the files are of different lists or of another version's, or a case is missing or
/// there twice.
WholeMap merge(const std::vector<std::filesystem::path>& files_and_folders);

}  // namespace osteomill::study
