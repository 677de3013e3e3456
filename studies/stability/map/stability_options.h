// `osteomill_study stability` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

StudyCommand add_stability(CLI::App& app);

}  // namespace osteomill::study
