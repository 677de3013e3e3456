// Score of a coupling in one scene: how much of the range it holds, and how true it is where it does.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

struct MethodScore {
    std::string method;
    MapScene scene = MapScene::cutting;
    std::size_t cases = 0;
    std::size_t stable = 0;
    /// Over the stable cases, share of the truth's mean force; NaN where none is stable.
    double median_rms_error = 0.0;
    double worst_rms_error = 0.0;
    double median_mean_error = 0.0;
    /// Over the cases that are stable with every method of the map: the others' easy cases do not flatter it.
    double common_rms_error = 0.0;

    double share() const { return static_cast<double>(stable) / static_cast<double>(cases); }
};

/// One for each method that the map has, in the order of map_methods(), over the points of that part and
/// scene.
std::vector<MethodScore> method_scores(const WholeMap& map, MapPart part, MapScene scene);

/// The table of the Pareto chart: the ends of its axis in decades of the error, in each line the same; share
/// and median error in percent; the height of the method's label in decades. Error and label are empty where
/// a method is stable nowhere.
Table pareto_table_of(const std::vector<MethodScore>& scores);

/// 1 for the first of map_methods(): what a chart's script picks colour and point by.
std::size_t number_of(const std::string& method);

}  // namespace osteomill::study
