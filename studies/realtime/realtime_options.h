// `osteomill_study realtime` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

StudyCommand add_realtime(CLI::App& app);

}  // namespace osteomill::study
