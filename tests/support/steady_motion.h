// Runs the milling model through a steady motion of the reference and averages its results.
#pragma once

#include "studies/force/steady_run.h"
#include "tests/support/block.h"
#include "tests/support/reference_cases.h"

namespace osteomill::testing {

using study::relative_error;

struct SteadyResult {
    glm::dvec3 mean_force_n{0.0};
    double removal_mm3_per_s = 0.0;
};

/// The burr enters the block, then travels `travel_mm` in steps of `step_s`; means over that travel.
inline SteadyResult run_steady(const ReferenceCase& c, double spacing_mm, double step_s, double travel_mm,
                               const MillingSettings& settings = {}) {
    const study::ForceSeries series = study::run_steady(
        c, {.voxel_mm = spacing_mm, .milling_rate_hz = 1.0 / step_s, .travel_mm = travel_mm},
        study::voxel_model(settings));
    return {study::mean_force_n(series), study::removal_mm3_per_s(series)};
}

}  // namespace osteomill::testing
