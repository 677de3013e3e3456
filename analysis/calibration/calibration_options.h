// `osteomill_study calibrate` on the command line.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

StudyCommand add_calibration(CLI::App& app);

}  // namespace osteomill::study
