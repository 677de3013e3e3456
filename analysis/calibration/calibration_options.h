// `osteomill_study calibrate` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "analysis/calibration/calibration_study.h"

namespace osteomill::study {

/// What was asked for: a fit of a table, or which runs to make.
struct CalibrationCommand {
    std::filesystem::path data;
    std::filesystem::path out = "study/calibration";
    bool designs = false;
    DesignOptions design{};
};

/// The subcommand, which fills in `command`; both outlive parsing.
CLI::App* add_calibration(CLI::App& app, CalibrationCommand& command);

}  // namespace osteomill::study
