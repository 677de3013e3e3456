// Surroundings of a study: where it says what it found and how far it has come.
#pragma once

#include <iosfwd>

namespace osteomill::study {

struct StudySurroundings {
    std::ostream& said;      ///< what was found and where the files are
    std::ostream& progress;  ///< how far it has come
    bool is_terminal = false;
};

}  // namespace osteomill::study
