// Runs as a dynamometer with normal noise would give them, of coefficients that are known.
#pragma once

#include <random>

#include "analysis/calibration/coefficient_fit.h"
#include "analysis/calibration/run_design.h"

namespace osteomill::study {

/// Twelve runs: two feeds of a revolution, three spindles, two depths.
inline std::vector<RunSetting> twelve_settings() {
    std::vector<RunSetting> settings;
    for (const double feed_mm_per_s : {1.0, 10.0})
        for (const double depth_mm : {0.5, 1.2})
            for (const double tilt_direction_deg : {0.0, 90.0, 200.0})
                settings.push_back({.feed_mm_per_s = feed_mm_per_s,
                                    .depth_mm = depth_mm,
                                    .tilt_deg = tilt_direction_deg == 0.0 ? 0.0 : 35.0,
                                    .tilt_direction_deg = tilt_direction_deg});
    return settings;
}

inline Coefficients known_coefficients() {
    Coefficients known;
    known << 230.0, 40.0, 20.0, 0.5, 0.8, 0.1;
    return known;
}

/// What the law says of each setting, without noise; the spread that a fit is told.
inline FitInput exact_forces(const std::vector<RunSetting>& settings, double spread_n) {
    std::vector<MeasuredRun> runs;
    for (const RunSetting& setting : settings)
        runs.push_back({.setting = setting, .spread_n = glm::dvec3(spread_n)});
    FitInput input = fit_input(runs);
    input.force_n = input.regressors * known_coefficients();
    return input;
}

/// The same forces with normal noise of `noise` spreads.
inline FitInput with_noise(FitInput input, double noise, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    for (Eigen::Index i = 0; i < input.force_n.size(); ++i)
        input.force_n(i) += noise * input.spread_n(i) * normal(random);
    return input;
}

}  // namespace osteomill::study
