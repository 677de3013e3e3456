// The study of the pictures: speed against accuracy, and how smooth a cut looks.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// `osteomill_study render`: writes render.json, accuracy.csv and its chart.
StudyCommand add_render(CLI::App& app);

}  // namespace osteomill::study
