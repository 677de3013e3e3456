// The voxel model beside the reference, case by case, as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "studies/force/steady_run.h"

namespace osteomill::study {

/// One case: "voxel_model", "reference" (the analytical reference of reference_force.h) and "file" (what the
/// case file says), each with mean_force_N and removal_mm3_s; error_percent (vector error over vector norm,
/// against the reference), file_error_percent (against the file), removal_error_percent, ripple_percent
/// (ripple() of force_series.h); step_us {p50, p99}; steps and travel_mm. An error against a force of zero
/// that is not met is null.
nlohmann::ordered_json report_of(const SteadyCase& c, const SteadyRun& run, const MakeModel& make_model);

}  // namespace osteomill::study
