// The published polishing experiment: figures 6, 7 and 8.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// `osteomill_study polishing`: writes figures.csv, a table a run and charts (SVG), and the logs of the
/// sessions into the folder `runs`.
StudyCommand add_polishing(CLI::App& app);

}  // namespace osteomill::study
