// `osteomill_study force` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

StudyCommand add_force(CLI::App& app);

}  // namespace osteomill::study
