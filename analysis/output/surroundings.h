// Surroundings of a study: where it says what it found and how far it has come, and how its cases are run.
#pragma once

#include <iosfwd>

#include "analysis/output/cases/study_parts.h"

namespace osteomill::study {

struct StudySurroundings {
    std::ostream& said;      ///< what was found and where the files are
    std::ostream& progress;  ///< how far it has come
    bool is_terminal = false;
    StudyParts parts{};
};

}  // namespace osteomill::study
