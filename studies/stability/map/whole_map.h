// The stability map once all of it has run.
#pragma once

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

}  // namespace osteomill::study
