// A run of one case of the stability map: the program's own loops, coupling and milling model (MillingSession
// on its virtual clock) on the bench's device, beside the truth of the same scene and hand.
#pragma once

#include "studies/stability/map/map_case.h"
#include "studies/stability/map/map_outcome.h"
#include "studies/stability/map/scene_cache.h"

namespace osteomill::study {

/// Throws std::invalid_argument for a case that the session refuses (an unknown method, a rate out of range).
/// Cases may share a cache and run in several threads.
MapOutcome run_map_case(const MapCase& c, SceneCache& cache);

/// With nothing to share.
MapOutcome run_map_case(const MapCase& c);

}  // namespace osteomill::study
