// `osteomill_study bridge` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

StudyCommand add_bridge(CLI::App& app);

}  // namespace osteomill::study
