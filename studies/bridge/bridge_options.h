// `osteomill_study bridge` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "studies/bridge/bridge_study.h"

namespace osteomill::study {

/// The subcommand, which fills in `options`; both outlive parsing.
CLI::App* add_bridge(CLI::App& app, BridgeStudyOptions& options);

}  // namespace osteomill::study
