// The study of calibration: the six coefficients of the milling law from runs on a dynamometer, or which runs
// a lab should make.
#pragma once

#include <filesystem>
#include <string>

#include "analysis/calibration/run_design.h"
#include "analysis/output/surroundings.h"

namespace osteomill::study {

struct CalibrationOptions {
    std::filesystem::path data;
    std::filesystem::path out;
};

/// Fits each material of the table and writes calibration.json, residuals.csv, scene.toml,
/// calibration_fit.svg and calibration_residuals.svg into `options.out`. Throws std::runtime_error in
/// one line where the table is wrong, a material's runs do not give its coefficients (none of these is
/// written then), or something cannot be written.
void calibrate(const CalibrationOptions& options, const StudySurroundings& surroundings);

struct DesignOptions {
    RunLattice lattice{};
    int runs = 24;
    std::string material = "bone";
    double spread_n = 0.05;  ///< for which expected intervals are printed
    std::uint64_t seed = 1;
    std::filesystem::path out;
};

/// Writes OUT/design.csv, a table to fill in, prints it and how it compares with the obvious choice. Throws
/// as optimal_design does.
void design_runs(const DesignOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
