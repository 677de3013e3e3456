// A sweep of many independent cases over several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "studies/stability/map/map_outcome.h"
#include "studies/stability/map/map_points.h"

namespace osteomill::study {

/// Runs one case. Thread-safe, and the same case always gives the same outcome.
using RunCase = std::function<MapOutcome(const MapCase&)>;

/// Told of each case as it ends, in no order, by one thread at a time.
using CaseDone = std::function<void(std::size_t index, const MapOutcome&)>;

/// Runs the points of those indices, in that order, on `jobs` threads (at least one). What `run` or `done`
/// throws stops the sweep after the cases that are under way, and is thrown here; what `run` throws becomes a
/// std::runtime_error that names the case.
void sweep(const std::vector<MapPoint>& points, const std::vector<std::size_t>& indices, int jobs,
           const RunCase& run, const CaseDone& done);

}  // namespace osteomill::study
