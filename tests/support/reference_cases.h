// The cases of tests/data/milling_forces.json: steady motions over a flat half space {p . up <= 0}, up = +z,
// with mean forces from an independent quadrature (2880 x 2880 points).
#pragma once

#include "studies/force/steady_case.h"

namespace osteomill::testing {

using ReferenceCase = study::SteadyCase;

inline std::vector<ReferenceCase> reference_cases() {
    return study::read_steady_cases(REPOSITORY "/tests/data/milling_forces.json");
}

}  // namespace osteomill::testing
