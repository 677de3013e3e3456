// `osteomill_study polishing` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "studies/polishing/polishing_study.h"

namespace osteomill::study {

/// The subcommand, which fills in `options`; both outlive parsing.
CLI::App* add_polishing(CLI::App& app, PolishingStudyOptions& options);

}  // namespace osteomill::study
