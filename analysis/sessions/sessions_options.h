// The command line of `osteomill_study sessions`.
#pragma once

#include <CLI/CLI.hpp>

#include "analysis/sessions/sessions_study.h"

namespace osteomill::study {

CLI::App* add_sessions(CLI::App& app, SessionsStudyOptions& options);

}  // namespace osteomill::study
