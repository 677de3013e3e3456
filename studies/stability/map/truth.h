// The truth of a case, the force on the hand if nothing were sampled: the scene in continuous time, with the
// same hand, from the release on. For a rigid mount the burr is the tool; for a compliant one it is a
// massless point on the mount's spring and damper, as the implicit coupling renders it.
//
// Each substep is solved implicitly (backward Euler, the bone's force at its end): the bone reaches 3500 N
// s/m, a time constant of 13 us on a bare arm. Halving the substep changes the force by less than 0.5 %. The
// exception is the first few milliseconds after a sudden push: the law's sideways part then makes a rigid
// tool ring at kHz. The substep blurs the exact decay of that ringing, but it damps out faster than anybody
// judges.
//
// The wall is a spring of the scene's stiffness between the burr and the plane, with the mount's damper
// beside it; it does not pull.
#pragma once

#include <vector>

#include "studies/stability/map/scene_plan.h"

namespace osteomill::study {

struct TruthTick {
    glm::dvec3 tool_mm{0.0};
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};  ///< on the tool
};

/// One for each tick from the release to the end of the tail.
std::vector<TruthTick> truth_of(const ScenePlan& plan, int substeps_per_tick = 100);

}  // namespace osteomill::study
