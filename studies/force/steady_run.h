// A run of a model through a steady motion, with its results.
#pragma once

#include "studies/force/path_run.h"
#include "studies/force/steady_case.h"
#include "studies/force/studied_model.h"

namespace osteomill::study {

struct SteadyRun {
    double voxel_mm = 0.1;
    double milling_rate_hz = 100.0;
    double travel_mm = 2.0;
    /// Never fewer, so that a fast feed at a low rate has a mean too.
    int min_steps = 20;
    /// How far the bone's surface, and the burr with it, is off its place in the lattice, outward.
    double surface_voxels = 0.0;
    /// Whether the bone's surface is as a burr leaves it (BoneBlock).
    bool is_milled = false;
    /// The path of a dive is no shorter than that, nor than the cut is deep.
    double least_dive_voxels = 0.0;
};

/// How far the burr goes. A motion along the surface goes on for `run.travel_mm` (or `min_steps`). A motion
/// that dives or climbs is steady only while the depth is near the case's: it passes that depth half-way, and
/// its depth changes at most by half a millimetre and by a third of the case's depth. A straight plunge is
/// the exception: once half of the burr is under the surface it stays steady, and it starts at the case's
/// depth.
struct SteadyPath {
    glm::dvec3 start_mm{0.0};
    glm::dvec3 end_mm{0.0};
    int steps = 0;
    double step_s = 0.0;
};
SteadyPath path_of(const SteadyCase& c, const SteadyRun& run);

/// Cuts the groove of an earlier pass if the case has one, puts the burr into the bone at the path's start,
/// and moves it along the path in equal steps; the series holds these. Throws std::invalid_argument if
/// voxels, rate or burr are none.
ForceSeries run_steady(const SteadyCase& c, const SteadyRun& run, const MakeModel& make_model);

}  // namespace osteomill::study
