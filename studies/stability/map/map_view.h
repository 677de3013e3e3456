// The cases of a whole map that a table or a chart is about.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

/// The share of nothing.
inline constexpr double no_share = std::numeric_limits<double>::quiet_NaN();

struct MapResult {
    const MapPoint& point;
    const MapOutcome& outcome;
};

/// In the list's order. `map` must outlive what is returned.
std::vector<MapResult> results_where(const WholeMap& map,
                                     const std::function<bool(const MapPoint&)>& is_wanted);

/// Share of those that are stable, 0 to 1; NaN of none.
double stable_share(const std::vector<MapResult>& results);

/// Errors as shares of the truth's mean force; NaN where that is 0.
double rms_error(const MapOutcome& outcome);
double mean_error(const MapOutcome& outcome);

}  // namespace osteomill::study
