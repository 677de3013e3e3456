// A map whose outcomes a test makes up.
#pragma once

#include <functional>

#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

inline WholeMap whole_map(const MapSelection& selection,
                          const std::function<MapOutcome(const MapCase&)>& outcome) {
    WholeMap map{.selection = selection, .points = map_points(selection), .outcomes = {}};
    for (const MapPoint& point : map.points) map.outcomes.push_back(outcome(point.run));
    return map;
}

}  // namespace osteomill::study
