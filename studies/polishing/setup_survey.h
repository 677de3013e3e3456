// Survey of the set-ups that make the simulated slide take the time and reach the depth that was published.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/output/progress.h"
#include "common/bone/bone.h"
#include "studies/polishing/polishing_setup.h"

namespace osteomill::study {

struct SurveyedSetup {
    PolishingSetup setup;
    bool reached_end = false;
    double slide_s = 0.0;
    double depth_mm = 0.0;      ///< largest
    double stray_mm = 0.0;      ///< largest, across the slide
    double mean_force_n = 0.0;  ///< of the force's length
    double peak_force_n = 0.0;
};

/// Spindle speeds x lengths of a stroke, a firm hand, the implicit coupling. Logs go to `folder`.
std::vector<SurveyedSetup> survey_setups(const Specimen& cube, bool quick,
                                         const std::filesystem::path& folder, const Progress& progress);

std::string csv_of(const std::vector<SurveyedSetup>& surveyed);

}  // namespace osteomill::study
