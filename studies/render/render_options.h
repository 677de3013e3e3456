// `osteomill_study render` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

StudyCommand add_render(CLI::App& app);

}  // namespace osteomill::study
