// The study of stability: the map, its tables and charts; or sites, or motions on rails, in its place.
#pragma once

#include "analysis/output/study_command.h"

namespace osteomill::study {

/// `osteomill_study stability`: writes map.csv, map.json, the tables of the charts and the charts (SVG).
StudyCommand add_stability(CLI::App& app);

}  // namespace osteomill::study
