// `osteomill_study sessions` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// `version`: of the program, which kept metrics are of.
StudyCommand add_sessions(CLI::App& app, const std::string& version);

}  // namespace osteomill::study
