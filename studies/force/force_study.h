// The study of the milling force: random motions, curves, the older contact models; its tables and charts.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// `osteomill_study force`: writes force.json, the tables (CSV) and the charts (SVG); or, of random motions
/// alone, random.json and random.csv; or, of a file's, cases.json.
StudyCommand add_force(CLI::App& app);

}  // namespace osteomill::study
