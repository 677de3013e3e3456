// Report of a calibration: its numbers, its residuals, a scene fragment.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/calibration/coefficient_fit.h"
#include "analysis/output/table.h"

namespace osteomill::study {

/// The runs of one material and what came of them.
struct MaterialCalibration {
    std::string material{};
    std::vector<MeasuredRun> runs{};
    FitInput input{};
    CoefficientFit fit{};
    std::vector<std::optional<Eigen::Vector3d>> predicted_n{};  ///< of each run, by the others
};

/// Root mean square of what is wrong with the predictions of runs by the others.
struct CrossValidation {
    double rms_n = 0.0;
    double rms_in_spreads = 0.0;
    int runs = 0;           ///< that the others predict
    int indispensable = 0;  ///< that they cannot
};
CrossValidation cross_validation_of(const MaterialCalibration& calibration);

/// What a reader of the numbers should know: scatter beyond the spreads, coefficients that are below zero or
/// that may be zero, runs that alone carry a coefficient. Each is one sentence.
std::vector<std::string> warnings_of(const MaterialCalibration& calibration);

nlohmann::ordered_json json_of(const MaterialCalibration& calibration);

/// A line for each force: run, material, material_number (from 1), axis (feed, across, up), axis_number,
/// measured_n, spread_n, fitted_n, residual_in_spreads, predicted_by_others_n.
Table residuals_of(const std::vector<MaterialCalibration>& calibrations);

/// A [[burrs]] table for each material and each burr that cut it, with intervals and source in comments. A
/// coefficient below 0, which a scene refuses, is 0 there, and a comment says so.
std::string scene_fragment(const std::vector<MaterialCalibration>& calibrations, const std::string& source);

}  // namespace osteomill::study
