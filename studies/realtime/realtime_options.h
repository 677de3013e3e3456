// `osteomill_study realtime` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "studies/realtime/realtime_study.h"

namespace osteomill::study {

/// The subcommand, which fills in `options`; both outlive parsing.
CLI::App* add_realtime(CLI::App& app, RealtimeStudyOptions& options);

}  // namespace osteomill::study
