// `osteomill_study polishing` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

StudyCommand add_polishing(CLI::App& app);

}  // namespace osteomill::study
