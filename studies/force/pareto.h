// Speed against accuracy: for each model and setting the time of a step and the error over the studied
// motions.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/progress.h"
#include "studies/force/studied_motion.h"

namespace osteomill::study {

/// A way to mill.
struct ParetoSetting {
    std::string family{};  ///< what it belongs to in the chart: "crescent of soft voxels" ...
    std::string label{};   ///< what tells it from the others of its family: "0.1 mm" ...
    MakeModel make{};
    double voxel_mm = 0.1;
    double milling_rate_hz = 100.0;
    double run_in_s = 0.0;    ///< of Discretisation
    bool is_default = false;  ///< what haptic_server does by default
};

/// Voxel sizes, bins, instants, soft, partial and binary voxels, crescent and full scan, milling rates. The
/// scan of 0.05 mm voxels, half a million of them, and some instants only where not `quick`.
std::vector<ParetoSetting> pareto_settings(bool quick);

struct ParetoPoint {
    ParetoSetting setting;
    double step_us_mean = 0.0;  ///< a model may wait for some steps and make up for them in others
    double step_us_p50 = 0.0;
    double step_us_p99 = 0.0;
    std::vector<double> errors{};  ///< by motion, mean over where the lattice lies
    double mean_error = 0.0;
    double worst_ripple = 0.0;
};

ParetoPoint measure(const ParetoSetting& setting, const std::vector<StudiedMotion>& motions, bool quick);

/// Table with a header; errors, ripple and core share in percent.
std::string csv_of(const std::vector<ParetoPoint>& points, const std::vector<StudiedMotion>& motions);

}  // namespace osteomill::study
