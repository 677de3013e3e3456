// The truth of a case, what the hand would feel if nothing were sampled: the scene in continuous time, with
// the same hand, from the release on. For a rigid mount the burr is the tool; for a compliant one it is a
// massless point on the mount's spring and damper, which is what the implicit coupling renders.
//
// Each substep is solved implicitly (backward Euler, the bone's force at its end): the bone reaches 3500 N
// s/m, a time constant of 13 us on a bare arm. Halving the substep changes the force by less than 0.5 %, but
// for what a sudden push shakes in the first few milliseconds: the law's sideways part makes a rigid tool
// ring at kHz there, which damps out faster than anybody judges and whose exact decay the substep blurs.
//
// The wall is a spring of the scene's stiffness between the burr and the plane, with the mount's damper
// beside it; it does not pull.
#pragma once

#include <vector>

#include "studies/stability/scene/scene_plan.h"

namespace osteomill::study {

struct TruthTick {
    glm::dvec3 tool_mm{0.0};
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};  ///< on the tool
};

/// One for each tick from the release to the end of the tail.
std::vector<TruthTick> truth_of(const ScenePlan& plan, int substeps_per_tick = 100);

}  // namespace osteomill::study
