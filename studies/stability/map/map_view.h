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

    /// What the scene is varied by: resistance, N s/m, or the wall's stiffness, N/mm.
    double x() const {
        return point.run.scene == MapScene::cutting ? outcome.resistance_n_s_per_m : point.run.wall_n_per_mm;
    }
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
